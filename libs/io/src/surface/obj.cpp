// Wavefront OBJ: vertices and faces; everything else is passed over.

#include "surface_formats.h"

#include "ostia/core/files.h"

#include <limits>

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

}  // namespace

LoadedSurface read_obj(const std::filesystem::path& path) {
  const std::string content = core::read_file(path);
  LoadedSurface loaded;
  geometry::TriMesh& mesh = loaded.surface.mesh;
  std::size_t polygons = 0;
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
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  if (polygons > 0)
    loaded.warnings.push_back(std::to_string(polygons) + " polygons were split into triangles");
  return loaded;
}

}  // namespace ostia::io
