#include "mesh/vtk_cells.h"

#include "vtk/xml.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkPoints.h>

#include <limits>

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

std::optional<Shape> shape_of(int type) {
  switch (type) {
    case VTK_TETRA:
    case VTK_QUADRATIC_TETRA:
      return Shape::tetrahedron;
    case VTK_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
      return Shape::prism;
    case VTK_TRIANGLE:
    case VTK_QUADRATIC_TRIANGLE:
      return Shape::triangle;
    case VTK_QUAD:
    case VTK_BIQUADRATIC_QUAD:
      return Shape::quad;
    default:
      return std::nullopt;
  }
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const PreparedMesh& mesh) {
  VtkCells cells;
  std::vector<std::int32_t> ids(mesh.elements(), 0);
  for (const Shape shape : volume_shapes)
    cells.add(shape, mesh.connectivity(shape, vtk_order), mesh.nodes(shape));
  for (const Shape shape : facet_shapes) cells.add(shape, mesh.connectivity(shape), mesh.nodes(shape));
  ids.insert(ids.end(), mesh.mesh.triangle_face_ids.begin(), mesh.mesh.triangle_face_ids.end());
  ids.insert(ids.end(), mesh.mesh.quad_face_ids.begin(), mesh.mesh.quad_face_ids.end());
  vtkSmartPointer<vtkUnstructuredGrid> grid = cells.grid(to_vtk(mesh.mesh.points));
  add_array(*grid->GetCellData(), "CellEntityIds", ids);
  if (mesh.layer_tetrahedra > 0) {
    std::vector<double> layer(ids.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < mesh.elements(); ++i)
      layer[i] = i < mesh.mesh.tetrahedra.size() && i + mesh.layer_tetrahedra >= mesh.mesh.tetrahedra.size();
    add_array(*grid->GetCellData(), layer_array, layer);
  }
  std::vector<geometry::Face> faces = mesh.mesh.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f].name = mesh.names[f];
  add_faces(*grid, faces);
  return grid;
}

}  // namespace ostia::io
