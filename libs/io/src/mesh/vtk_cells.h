#pragma once
/// \file Elements and facets as VTK's cells.

#include "mesh/prepared.h"

#include "ostia/io/volume_mesh_file.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <optional>

namespace ostia::io {

/// Cells of one grid, added shape by shape.
class VtkCells {
 public:
  VtkCells();
  void add(Shape shape, const std::vector<std::int32_t>& connectivity, std::size_t nodes);
  vtkSmartPointer<vtkUnstructuredGrid> grid(vtkSmartPointer<vtkPoints> points) const;

 private:
  vtkSmartPointer<vtkCellArray> cells_;
  std::vector<int> types_;
};

/// What a cell of VTK's type is to us; nothing for those that we do not have.
std::optional<Shape> shape_of(int vtk_type);

/// The mesh that a file's grid is. Throws InvalidInput as read_volume_mesh does.
LayeredMesh mesh_of(vtkUnstructuredGrid& data, const std::filesystem::path& path);

/// The other way: tetrahedra, prisms, then the boundary's triangles and quadrilaterals, told apart by
/// CellEntityIds, with the faces' names as field data.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const PreparedMesh& mesh);

}  // namespace ostia::io
