// Triangles of VTK's polygons and strips.

#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/files.h"
#include "ostia/geometry/polygon.h"

#include <vtkCellArray.h>

namespace ostia::io {
namespace fs = std::filesystem;

PolydataTriangles triangles_of(vtkPolyData& data, const fs::path& path) {
  PolydataTriangles out;
  const auto point = [](vtkIdType id) { return static_cast<std::int32_t>(id); };
  const auto corners_of = [&](vtkCellArray& cells, vtkIdType cell, const std::string& kind) {
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    cells.GetCellAtId(cell, count, corners);
    if (count < 3) refuse(path, kind + " " + std::to_string(cell) + " has fewer than three corners");
    return std::vector<vtkIdType>(corners, corners + count);
  };
  std::vector<geometry::Vec3> points;  // those of triangles are not asked for
  vtkIdType first = data.GetNumberOfVerts() + data.GetNumberOfLines();
  for (vtkIdType p = 0; p < data.GetNumberOfPolys(); ++p) {
    const std::vector<vtkIdType> at = corners_of(*data.GetPolys(), p, "polygon");
    if (at.size() > 3 && out.polygons++ == 0) points = from_vtk(data.GetPoints());
    std::vector<std::int32_t> polygon;
    for (const vtkIdType corner : at) polygon.push_back(point(corner));
    for (const geometry::Triangle& t : geometry::triangles_of_polygon(points, polygon)) {
      out.triangles.push_back(t);
      out.cells.push_back(first + p);
    }
  }
  first += data.GetNumberOfPolys();
  for (vtkIdType s = 0; s < data.GetNumberOfStrips(); ++s) {
    const std::vector<vtkIdType> at = corners_of(*data.GetStrips(), s, "strip");
    for (std::size_t i = 2; i < at.size(); ++i) {
      const vtkIdType a = at[i - 2], b = at[i - 1], c = at[i];
      if (a == b || b == c || a == c) continue;  // strips are joined by corners that repeat
      const bool even = i % 2 == 0;              // every other one is turned
      out.triangles.push_back({point(even ? a : b), point(even ? b : a), point(c)});
      out.cells.push_back(first + s);
    }
  }
  return out;
}

bool legacy_has_polygons(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  const std::string content = core::read_file(path);
  if (content.compare(0, 5, "# vtk") != 0) return false;
  for (const std::string_view name : {"\nPOLYGONS ", "\nTRIANGLE_STRIPS "}) {
    for (std::size_t at = content.find(name); at != std::string::npos; at = content.find(name, at + 1)) {
      Words line(std::string_view(content).substr(at + name.size(), 80));
      const auto count = number<std::int64_t>(line.next());
      if (count && *count != 0) return true;
    }
  }
  return false;
}

}  // namespace ostia::io
