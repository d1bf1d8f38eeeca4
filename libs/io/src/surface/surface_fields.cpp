#include "ostia/io/surface_fields.h"

#include "surface_formats.h"
#include "vtk/fields.h"
#include "vtk/xml.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <vector>

namespace ostia::io {
namespace {

/// Of each triangle that read_vtp makes, VTK's cell.
std::vector<std::size_t> cells_of_triangles(vtkPolyData& data, const std::filesystem::path& path) {
  std::vector<std::size_t> cells;
  for (const vtkIdType cell : triangles_of(data, path).cells) cells.push_back(static_cast<std::size_t>(cell));
  return cells;
}

}  // namespace

SurfaceWithFields read_surface_with_fields(const std::filesystem::path& path) {
  if (path.extension() != ".vtp" && path.extension() != ".vtk")
    refuse(path, "results on a surface are read from VTP files (.vtp)");
  SurfaceWithFields read;
  read.mesh = read_vtp(path).surface.mesh;
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  const std::vector<std::size_t> cells = cells_of_triangles(*data, path);
  read.points =
      fields_of(*data->GetPointData(), read.mesh.points.size(), [](std::size_t point) { return point; });
  read.triangles =
      fields_of(*data->GetCellData(), cells.size(), [&](std::size_t triangle) { return cells[triangle]; });
  return read;
}

}  // namespace ostia::io
