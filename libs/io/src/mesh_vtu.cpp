// VTK's unstructured grid: elements and boundary facets together, told apart by CellEntityIds.

#include "mesh_formats.h"
#include "mesh_text.h"
#include "mesh_vtk_cells.h"
#include "vtk_xml.h"

#include <vtkCellData.h>

namespace ostia::io {

void write_vtu(const PreparedMesh& mesh, const std::filesystem::path& file) {
  VtkCells cells;
  std::vector<std::int32_t> ids(mesh.elements(), 0);
  for (const Shape shape : volume_shapes)
    cells.add(shape, mesh.connectivity(shape, vtk_order), mesh.nodes(shape));
  for (const Shape shape : facet_shapes) cells.add(shape, mesh.connectivity(shape), mesh.nodes(shape));
  ids.insert(ids.end(), mesh.mesh.triangle_face_ids.begin(), mesh.mesh.triangle_face_ids.end());
  ids.insert(ids.end(), mesh.mesh.quad_face_ids.begin(), mesh.mesh.quad_face_ids.end());
  const vtkSmartPointer<vtkUnstructuredGrid> grid = cells.grid(to_vtk(mesh.mesh.points));
  add_array(*grid->GetCellData(), "CellEntityIds", ids);
  std::vector<geometry::Face> faces = mesh.mesh.faces;
  for (std::size_t f = 0; f < faces.size(); ++f) faces[f].name = mesh.names[f];
  add_faces(*grid, faces);
  write_whole(file, grid_text(*grid));
}

}  // namespace ostia::io
