// SimVascular's mesh-complete folder: one cell type, ids from 1, surfaces as polygons with the ids of the
// volume's nodes and elements.

#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/vtk_cells.h"
#include "vtk/xml.h"

#include "ostia/geometry/faces.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <numeric>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

std::vector<std::int32_t> counted_from_one(std::size_t n) {
  std::vector<std::int32_t> ids(n);
  std::iota(ids.begin(), ids.end(), 1);
  return ids;
}

std::string volume_text(const PreparedMesh& mesh) {
  VtkCells cells;
  cells.add(Shape::tetrahedron, mesh.connectivity(Shape::tetrahedron, vtk_order),
            mesh.nodes(Shape::tetrahedron));
  const auto grid = cells.grid(to_vtk(mesh.mesh.points));
  add_array(*grid->GetPointData(), "GlobalNodeID", counted_from_one(mesh.mesh.points.size()));
  add_array(*grid->GetCellData(), "GlobalElementID", counted_from_one(mesh.elements()));
  add_array(*grid->GetCellData(), "ModelRegionID", std::vector<std::int32_t>(mesh.elements(), 1));
  return grid_text(*grid);
}

/// The named boundary triangles with the points that they use, in the volume's order.
std::string surface_text(const PreparedMesh& mesh, const std::vector<std::int32_t>& triangles) {
  const std::vector<std::int32_t> corners = mesh.connectivity(Shape::triangle, triangles);
  std::vector<std::int32_t> used = corners;
  std::ranges::sort(used);
  used.erase(std::ranges::unique(used).begin(), used.end());
  vtkNew<vtkPolyData> data;
  std::vector<geometry::Vec3> points;
  std::vector<std::int32_t> node_ids, element_ids, face_ids;
  for (const std::int32_t p : used) {
    points.push_back(mesh.mesh.points[static_cast<std::size_t>(p)]);
    node_ids.push_back(p + 1);
  }
  vtkNew<vtkCellArray> polygons;
  const auto local = [&](std::int32_t p) {
    return static_cast<vtkIdType>(std::ranges::lower_bound(used, p) - used.begin());
  };
  for (std::size_t i = 0; i < corners.size(); i += 3)
    polygons->InsertNextCell({local(corners[i]), local(corners[i + 1]), local(corners[i + 2])});
  for (const std::int32_t t : triangles) {
    element_ids.push_back(mesh.parent(Shape::triangle, t).element + 1);
    face_ids.push_back(mesh.mesh.triangle_face_ids[static_cast<std::size_t>(t)]);
  }
  data->SetPoints(to_vtk(points));
  data->SetPolys(polygons);
  add_array(*data->GetPointData(), "GlobalNodeID", node_ids);
  add_array(*data->GetCellData(), "GlobalElementID", element_ids);
  add_array(*data->GetCellData(), "ModelFaceID", face_ids);
  return polydata_text(*data);
}

}  // namespace

void write_mesh_complete(const PreparedMesh& mesh, const fs::path& folder) {
  make_folders(folder / "mesh-surfaces");
  write_whole(folder / "mesh-complete.mesh.vtu", volume_text(mesh));
  std::vector<std::int32_t> exterior(mesh.mesh.triangles.size()), walls;
  std::iota(exterior.begin(), exterior.end(), 0);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const std::vector<std::int32_t>& triangles = mesh.facets[f].triangles;
    write_whole(folder / "mesh-surfaces" / (mesh.names[f] + ".vtp"), surface_text(mesh, triangles));
    if (is_wall(mesh.mesh.faces[f])) walls.insert(walls.end(), triangles.begin(), triangles.end());
  }
  write_whole(folder / "mesh-complete.exterior.vtp", surface_text(mesh, exterior));
  if (!walls.empty()) write_whole(folder / "walls_combined.vtp", surface_text(mesh, walls));
}

}  // namespace ostia::io
