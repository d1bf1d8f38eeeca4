// Wavefront OBJ: vertices, faces and groups; everything else is passed over.

#include "surface_formats.h"

#include "ostia/core/files.h"
#include "ostia/geometry/polygon.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

namespace ostia::io {
namespace {

std::int32_t point_index(std::string_view word, std::size_t points, const std::filesystem::path& path) {
  const auto value = number<std::int64_t>(word.substr(0, word.find('/')));
  if (!value || *value == 0) refuse(path, "face corner \"" + std::string(word) + "\" is no vertex number");
  const std::int64_t index = *value > 0 ? *value - 1 : static_cast<std::int64_t>(points) + *value;
  if (index < 0 || index > std::numeric_limits<std::int32_t>::max()) {
    refuse(path, "face corner \"" + std::string(word) + "\" is out of range");
  }
  return static_cast<std::int32_t>(index);
}

/// Groups (`g NAME`) as faces, numbered in the order of their first triangles; the wall keeps number 1.
class ObjGroups {
 public:
  void begin(std::string_view name) { now_ = std::string(name.substr(0, name.find_last_not_of(" \t") + 1)); }
  void add_triangle(std::vector<std::int32_t>& ids) {
    const auto [found, fresh] = numbers_.try_emplace(now_, static_cast<std::int32_t>(numbers_.size()) + 1);
    if (fresh) names_.push_back(now_);
    ids.push_back(found->second);
  }
  /// One group says nothing.
  void finish(geometry::FacedSurface& surface) const {
    if (names_.size() < 2) {
      surface.face_ids.clear();
      return;
    }
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto id = static_cast<std::int32_t>(i) + 1;
      surface.faces.push_back(names_[i].empty() ? face_without_name(id) : face_named(id, names_[i]));
    }
  }

 private:
  std::string now_;
  std::map<std::string, std::int32_t> numbers_;
  std::vector<std::string> names_;
};

}  // namespace

LoadedSurface read_obj(const std::filesystem::path& path) {
  const std::string content = core::read_file(path);
  LoadedSurface loaded;
  geometry::TriMesh& mesh = loaded.surface.mesh;
  std::size_t polygons = 0;
  ObjGroups groups;
  Words lines(content);
  while (!lines.empty()) {
    Words words(lines.line());
    const std::string_view key = words.next();
    if (key == "v") {
      geometry::Vec3 point;
      for (double& value : point) {
        const std::string_view text = words.next();
        const auto read = number<double>(text);
        if (!read)
          refuse(path, "vertex " + std::to_string(mesh.points.size() + 1) + ": \"" + std::string(text) +
                           "\" is no number");
        value = *read;
      }
      mesh.points.push_back(point);
    } else if (key == "f") {
      std::vector<std::int32_t> corners;
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        corners.push_back(point_index(word, mesh.points.size(), path));
      }
      if (corners.size() < 3) refuse(path, "a face has fewer than three corners");
      polygons += corners.size() > 3;
      for (const geometry::Triangle& t : geometry::triangles_of_polygon(mesh.points, corners)) {
        mesh.triangles.push_back(t);
        groups.add_triangle(loaded.surface.face_ids);
      }
    } else if (key == "g") {
      const std::string_view name = words.rest();
      groups.begin(name.substr(std::min(name.find_first_not_of(" \t"), name.size())));
    }
  }
  groups.finish(loaded.surface);
  if (polygons > 0)
    loaded.warnings.push_back(std::to_string(polygons) + " polygons were split into triangles");
  return loaded;
}

}  // namespace ostia::io
