// Stereolithography files, ASCII and binary (3D Systems 1989).

#include "surface_formats.h"

#include "ostia/core/files.h"

#include <cstring>
#include <limits>
#include <unordered_map>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

struct Corner {
  std::array<float, 3> xyz;
  bool operator==(const Corner& other) const {
    return std::memcmp(xyz.data(), other.xyz.data(), sizeof xyz) == 0;
  }
};
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy(bits.data(), corner.xyz.data(), sizeof bits);
    std::size_t hash = 1469598103934665603ULL;
    for (const std::uint32_t b : bits) hash = (hash ^ b) * 1099511628211ULL;
    return hash ^ (hash >> 29);
  }
};

/// Gives corners that are equal bit for bit (-0 counts as 0) one index.
class Points {
 public:
  explicit Points(TriMesh& mesh) : mesh_(mesh) {}
  std::int32_t index(std::array<float, 3> xyz) {
    for (float& value : xyz) value += 0.0f;  // -0 -> 0
    const auto [found, added] =
        index_.try_emplace(Corner{xyz}, static_cast<std::int32_t>(mesh_.points.size()));
    if (added) mesh_.points.emplace_back(xyz[0], xyz[1], xyz[2]);
    return found->second;
  }

 private:
  TriMesh& mesh_;
  std::unordered_map<Corner, std::int32_t, CornerHash> index_;
};

std::uint32_t facet_count(const std::string& content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + 80, sizeof count);
  return count;
}

bool looks_ascii(const std::string& content) {
  if (content.compare(0, 5, "solid") != 0) return false;
  // Some binary files begin with "solid": their declared size gives them away.
  if (content.size() >= header_bytes &&
      content.size() == header_bytes + facet_bytes * std::size_t{facet_count(content)})
    return false;
  const std::string_view start(content.data(), std::min<std::size_t>(content.size(), 4096));
  return start.find("facet") != std::string_view::npos || start.find("endsolid") != std::string_view::npos;
}

TriMesh read_binary(const std::string& content, const fs::path& path) {
  if (content.size() < header_bytes)
    refuse(path, "an STL needs at least 84 bytes, the file has " + std::to_string(content.size()));
  const std::size_t count = facet_count(content);
  if (count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 3) {
    refuse(path, "its triangle count " + std::to_string(count) + " is beyond what a mesh can hold");
  }
  const std::size_t needed = header_bytes + facet_bytes * count;
  if (content.size() < needed) {
    refuse(path, "its header counts " + std::to_string(count) + " triangles, which takes " +
                     std::to_string(needed) + " bytes, but the file has " + std::to_string(content.size()) +
                     ": it is cut short");
  }
  TriMesh mesh;
  mesh.triangles.reserve(count);
  Points points(mesh);
  for (std::size_t f = 0; f < count; ++f) {
    geometry::Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::array<float, 3> xyz{};
      std::memcpy(xyz.data(), content.data() + header_bytes + facet_bytes * f + 12 * (corner + 1),
                  sizeof xyz);
      triangle[corner] = points.index(xyz);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TriMesh read_ascii(const std::string& content, const fs::path& path) {
  TriMesh mesh;
  Points points(mesh);
  Words words(content);
  geometry::Triangle triangle{};
  std::size_t corners = 0;
  bool ended = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "endsolid") ended = true;
    if (word != "vertex") continue;
    ended = false;
    std::array<float, 3> xyz{};
    for (float& value : xyz) {
      const std::string_view text = words.next();
      const auto read = number<float>(text);
      if (!read)
        refuse(path, "triangle " + std::to_string(mesh.triangles.size()) + ": vertex coordinate \"" +
                         std::string(text) + "\" is no number");
      value = *read;
    }
    triangle[corners] = points.index(xyz);
    if (++corners == 3) {
      mesh.triangles.push_back(triangle);
      corners = 0;
    }
  }
  if (corners != 0 || !ended)
    refuse(path, "it ends after " + std::to_string(mesh.triangles.size()) +
                     " triangles without \"endsolid\": it is cut short");
  return mesh;
}

}  // namespace

LoadedSurface read_stl(const fs::path& path) {
  const std::string content = core::read_file(path);
  LoadedSurface loaded;
  loaded.surface.mesh = looks_ascii(content) ? read_ascii(content, path) : read_binary(content, path);
  return loaded;
}

std::string stl_text(const TriMesh& mesh) {
  std::string out = "Ostia surface, axes LPS, unit mm";
  out.resize(80, ' ');
  const auto append = [&out](const auto& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  out.reserve(header_bytes + facet_bytes * mesh.triangles.size());
  for (const geometry::Triangle& t : mesh.triangles) {
    const Vec3 normal = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
    const Vec3 unit = normal.norm() > 0.0 ? Vec3(normal.normalized()) : Vec3(Vec3::Zero());
    for (const double value : unit) append(static_cast<float>(value));
    for (const std::int32_t p : t) {
      for (const double value : mesh.points[p]) append(static_cast<float>(value));
    }
    append(std::uint16_t{0});
  }
  return out;
}

}  // namespace ostia::io
