// Stereolithography files, ASCII and binary (3D Systems 1989).

#include "surface_formats.h"

#include "ostia/core/files.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::TriMesh;

constexpr std::size_t header_bytes = 84;
constexpr std::size_t facet_bytes = 50;

using Corner = std::array<float, 3>;

/// Gives corners that are equal bit for bit (-0 counts as 0) one index: a table of open places, at least half
/// of them free.
class Points {
 public:
  Points(TriMesh& mesh, std::size_t triangles) : mesh_(mesh), places_(64, -1) {
    mesh_.points.reserve(triangles / 2 + 2);  // of a closed surface
    corners_.reserve(triangles / 2 + 2);
  }
  std::int32_t index(Corner corner) {
    for (float& value : corner) value += 0.0f;  // -0 -> 0
    if (2 * (corners_.size() + 1) > places_.size()) grow();
    std::int32_t& place = places_[place_of(corner)];
    if (place < 0) {
      place = static_cast<std::int32_t>(corners_.size());
      corners_.push_back(corner);
      mesh_.points.emplace_back(corner[0], corner[1], corner[2]);
    }
    return place;
  }

 private:
  using Bits = std::array<std::uint32_t, 3>;

  /// Where it is, or the free place where it belongs.
  std::size_t place_of(const Corner& corner) const {
    const auto bits = std::bit_cast<Bits>(corner);
    std::size_t hash = 1469598103934665603ULL;
    for (const std::uint32_t b : bits) hash = (hash ^ b) * 1099511628211ULL;
    hash = (hash ^ hash >> 29) * 0x9e3779b97f4a7c15ULL >> 24;  // short decimals leave low bits alike
    std::size_t place = hash & (places_.size() - 1);
    while (places_[place] >= 0 &&
           std::bit_cast<Bits>(corners_[static_cast<std::size_t>(places_[place])]) != bits)
      place = (place + 1) & (places_.size() - 1);
    return place;
  }
  void grow() {
    places_.assign(4 * places_.size(), -1);
    for (std::size_t i = 0; i < corners_.size(); ++i)
      places_[place_of(corners_[i])] = static_cast<std::int32_t>(i);
  }

  TriMesh& mesh_;
  std::vector<Corner> corners_;
  std::vector<std::int32_t> places_;  // as many as a power of two
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
  Points points(mesh, count);
  for (std::size_t f = 0; f < count; ++f) {
    geometry::Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Corner xyz{};
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
  Points points(mesh, 0);
  Words words(content);
  geometry::Triangle triangle{};
  std::size_t corners = 0;
  bool ended = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "endsolid") ended = true;
    if (word != "vertex") continue;
    ended = false;
    Corner xyz{};
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

}  // namespace ostia::io
