#include "ostia/geometry/stl.h"

#include <bit>
#include <cstdint>

namespace ostia::geometry {
namespace {

template <class Number>
void append(std::string& to, Number number) {
  for (std::size_t n = 0; n < sizeof number; ++n) to += static_cast<char>(number >> (8 * n) & 0xFF);
}

void append_stl_vector(std::string& to, const Vec3& v) {
  for (const double value : v) append(to, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

}  // namespace

std::string binary_stl(const TriMesh& mesh) {
  std::string out = "Ostia surface, axes LPS, unit mm";
  out.resize(80, ' ');
  out.reserve(84 + 50 * mesh.triangles.size());
  append(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t n) -> const Vec3& {
      return mesh.points[static_cast<std::size_t>(t[n])];
    };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    append_stl_vector(out, normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero()));
    for (std::size_t n = 0; n < 3; ++n) append_stl_vector(out, corner(n));
    append(out, std::uint16_t{0});
  }
  return out;
}

}  // namespace ostia::geometry
