#include "ostia/io/volume_mesh_file.h"

#include "formats.h"
#include "mesh_builder.h"
#include "mesh_readers.h"
#include "vtk_xml.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>

#include <optional>

namespace ostia::io {
namespace fs = std::filesystem;
namespace {

using geometry::MixedMesh;

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

}  // namespace

MixedMesh read_vtu(const fs::path& path) {
  const vtkSmartPointer<vtkUnstructuredGrid> data = read_grid(path);
  MeshBuilder mesh(path);
  mesh.points() = from_vtk(data->GetPoints());
  vtkDataArray* ids = data->GetCellData()->GetArray("CellEntityIds");
  std::vector<std::int32_t> nodes;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* p = nullptr;
    data->GetCells()->GetCellAtId(c, count, p);
    nodes.assign(p, p + count);
    const std::optional<Shape> shape = shape_of(data->GetCellType(c));
    const std::int32_t face = ids ? static_cast<std::int32_t>(ids->GetTuple1(c)) : 1;
    if (!shape || !mesh.add(*shape, nodes, face, vtk_order))
      refuse(path, "cell " + std::to_string(c) + " is of VTK type " + std::to_string(data->GetCellType(c)) +
                       " with " + std::to_string(count) +
                       " points; tetrahedra (10, 24), prisms (13, 32), triangles (5, 22) and quadrilaterals "
                       "(9, 28) are read");
  }
  return mesh.finish(mesh.has_boundary() ? faces_of(*data, mesh.face_ids()) : std::vector<geometry::Face>());
}

bool is_volume_mesh(const fs::path& path) {
  return path.extension() == ".vtu" || path.extension() == ".msh";
}

std::string readable_volume_meshes() {
  return "VTU (.vtu) and ASCII Gmsh 2.2 or 4.1 (.msh)";
}

MixedMesh read_volume_mesh(const fs::path& path) {
  return path.extension() == ".msh" ? read_gmsh(path) : read_vtu(path);
}

}  // namespace ostia::io
