// Fluent's mesh, ASCII (Fluent User's Guide, "Mesh File Format"): faces with the cells on both sides, all
// integers but the sections' numbers and the zones' names in hexadecimal.

#include "mesh/formats.h"
#include "mesh/text.h"

#include <algorithm>
#include <charconv>

namespace ostia::io {
namespace {

constexpr int interior = 2, wall = 3, pressure_outlet = 5, velocity_inlet = 10;

std::string hex(std::size_t value) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  return {digits.data(), end};
}

int condition_of(geometry::FaceKind kind) {
  switch (kind) {
    case geometry::FaceKind::inlet:
      return velocity_inlet;
    case geometry::FaceKind::outlet:
      return pressure_outlet;
    default:
      return wall;
  }
}

std::string_view condition_name(int condition) {
  return condition == velocity_inlet    ? "velocity-inlet"
         : condition == pressure_outlet ? "pressure-outlet"
                                        : "wall";
}

/// The nodes' right-hand normal points into the first cell: the side is turned round.
void put_face(TextFile& out, const std::array<std::int32_t, 4>& corners, std::int32_t into,
              std::int32_t from) {
  const std::size_t n = corners[3] < 0 ? 3 : 4;
  out << n;
  for (std::size_t i = 0; i < n; ++i) out << ' ' << hex(static_cast<std::size_t>(corners[i]) + 1);
  out << ' ' << hex(static_cast<std::size_t>(into + 1)) << ' ' << hex(static_cast<std::size_t>(from + 1))
      << '\n';
}

void put_points(TextFile& out, const PreparedMesh& mesh) {
  const std::string n = hex(mesh.mesh.points.size());
  out << "(10 (0 1 " << n << " 0 3))\n(10 (1 1 " << n << " 1 3)(\n";
  for (const geometry::Vec3& p : mesh.mesh.points) out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  out << "))\n";
}

void put_cells(TextFile& out, const PreparedMesh& mesh, std::size_t zone) {
  constexpr int tetrahedron = 2, wedge = 6;
  const std::size_t tetrahedra = mesh.mesh.tetrahedra.size(), prisms = mesh.mesh.prisms.size();
  const std::string n = hex(mesh.elements());
  out << "(12 (0 1 " << n << " 0))\n(12 (" << hex(zone) << " 1 " << n << " 1 ";
  if (prisms == 0 || tetrahedra == 0) {
    out << (prisms == 0 ? tetrahedron : wedge) << "))\n";
    return;
  }
  out << "0)(\n";
  for (std::size_t e = 0; e < mesh.elements(); ++e)
    out << (e < tetrahedra ? tetrahedron : wedge) << (e % 40 == 39 ? '\n' : ' ');
  out << "\n))\n";
}

}  // namespace

void write_fluent(const PreparedMesh& mesh, const std::filesystem::path& file) {
  const std::size_t volume = static_cast<std::size_t>(volume_id(mesh)), inside = volume + 1;
  TextFile out(file);
  out << "(0 \"" << mesh.title << ", axes LPS, unit mm\")\n(2 3)\n";
  put_points(out, mesh);
  put_cells(out, mesh, volume);
  std::size_t next = mesh.inner.size() + mesh.mesh.triangles.size() + mesh.mesh.quads.size();
  out << "(13 (0 1 " << hex(next) << " 0))\n";
  if (!mesh.inner.empty()) {
    out << "(13 (" << hex(inside) << " 1 " << hex(mesh.inner.size()) << ' ' << interior << " 0)(\n";
    for (const InnerSide& side : mesh.inner)
      put_face(out, mesh.corners(side.first), side.second.element, side.first.element);
    out << "))\n";
  }
  next = mesh.inner.size() + 1;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const PreparedMesh::Facets& facets = mesh.facets[f];
    const auto condition = static_cast<std::size_t>(condition_of(mesh.mesh.faces[f].kind));
    out << "(13 (" << hex(static_cast<std::size_t>(mesh.mesh.faces[f].id)) << ' ' << hex(next) << ' '
        << hex(next + facets.size() - 1) << ' ' << hex(condition) << " 0)(\n";
    for (const Shape shape : facet_shapes) {
      for (const std::int32_t facet : facets.of(shape)) {
        const ElementSide& side = mesh.parent(shape, facet);
        std::array<std::int32_t, 4> corners = mesh.corners(side);
        std::reverse(corners.begin(), corners.begin() + (corners[3] < 0 ? 3 : 4));
        put_face(out, corners, side.element, -1);
      }
    }
    out << "))\n";
    next += facets.size();
  }
  out << "(45 (" << volume << " fluid " << mesh.title << ")())\n";
  if (!mesh.inner.empty()) out << "(45 (" << inside << " interior interior-" << mesh.title << ")())\n";
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    out << "(45 (" << mesh.mesh.faces[f].id << ' ' << condition_name(condition_of(mesh.mesh.faces[f].kind))
        << ' ' << mesh.names[f] << ")())\n";
  out.close();
}

}  // namespace ostia::io
