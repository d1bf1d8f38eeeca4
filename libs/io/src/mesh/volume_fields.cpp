#include "ostia/io/volume_fields.h"

#include "mesh/text.h"
#include "mesh/vtk_cells.h"
#include "vtk/fields.h"
#include "vtk/xml.h"

#include "ostia/core/files.h"

#include <vtkCellData.h>
#include <vtkPointData.h>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

/// VTK's cells that are elements: tetrahedra, then prisms.
std::vector<std::size_t> elements_of(vtkUnstructuredGrid& grid) {
  std::vector<std::size_t> elements;
  for (const Shape shape : volume_shapes) {
    for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
      if (shape_of(grid.GetCellType(c)) == shape) elements.push_back(static_cast<std::size_t>(c));
    }
  }
  return elements;
}

}  // namespace

void write_vtu_with_fields(const fs::path& path, const geometry::MixedMesh& mesh,
                           const VolumeFields& fields) {
  const PreparedMesh prepared = prepare(mesh, "mesh");
  const vtkSmartPointer<vtkUnstructuredGrid> grid = grid_of(prepared);
  add_fields(*grid->GetCellData(), fields.cells, prepared.elements(),
             static_cast<std::size_t>(grid->GetNumberOfCells()), "elements");
  add_fields(*grid->GetPointData(), fields.points, mesh.points.size(), mesh.points.size(), "points");
  core::write_file(path, grid_text(*grid));
}

VolumeFields read_vtu_fields(const fs::path& path) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(path);
  const std::size_t points = mesh_of(*grid, path).mesh.points.size();  // refuses what is no mesh
  const std::vector<std::size_t> elements = elements_of(*grid);
  return {fields_of(*grid->GetCellData(), elements.size(), [&](std::size_t i) { return elements[i]; }),
          fields_of(*grid->GetPointData(), points, [](std::size_t i) { return i; })};
}

}  // namespace ostia::io
