#include "mesh_vtk_cells.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkPoints.h>

namespace ostia::io {
namespace {

int cell_type(Shape shape, std::size_t nodes) {
  switch (shape) {
    case Shape::tetrahedron:
      return nodes == 4 ? VTK_TETRA : VTK_QUADRATIC_TETRA;
    case Shape::prism:
      return nodes == 6 ? VTK_WEDGE : VTK_BIQUADRATIC_QUADRATIC_WEDGE;
    case Shape::triangle:
      return nodes == 3 ? VTK_TRIANGLE : VTK_QUADRATIC_TRIANGLE;
    default:
      return nodes == 4 ? VTK_QUAD : VTK_BIQUADRATIC_QUAD;
  }
}

}  // namespace

VtkCells::VtkCells() : cells_(vtkSmartPointer<vtkCellArray>::New()) {}

void VtkCells::add(Shape shape, const std::vector<std::int32_t>& connectivity, std::size_t nodes) {
  std::vector<vtkIdType> cell(nodes);
  for (std::size_t i = 0; i < connectivity.size(); i += nodes) {
    std::copy_n(connectivity.begin() + static_cast<std::ptrdiff_t>(i), nodes, cell.begin());
    cells_->InsertNextCell(static_cast<vtkIdType>(nodes), cell.data());
    types_.push_back(cell_type(shape, nodes));
  }
}

vtkSmartPointer<vtkUnstructuredGrid> VtkCells::grid(vtkSmartPointer<vtkPoints> points) const {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  std::vector<int> types = types_;
  grid->SetCells(types.data(), cells_);
  return grid;
}

}  // namespace ostia::io
