#pragma once
/// \file Elements and facets as VTK's cells.

#include "mesh_prepared.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

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

}  // namespace ostia::io
