#include "ostia/io/volume_mesh_file.h"

#include "mesh/builder.h"
#include "mesh/readers.h"
#include "mesh/vtk_cells.h"
#include "surface_formats.h"
#include "vtk/xml.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>

#include <fstream>
#include <optional>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::MixedMesh;

LayeredMesh mesh_of(vtkUnstructuredGrid& data, const fs::path& path) {
  MeshBuilder mesh(path);
  mesh.points() = from_vtk(data.GetPoints());
  vtkDataArray* ids = data.GetCellData()->GetArray("CellEntityIds");
  vtkDataArray* layer = data.GetCellData()->GetArray(layer_array);
  if (layer && layer->GetNumberOfComponents() != 1) layer = nullptr;
  std::vector<std::int32_t> nodes;
  for (vtkIdType c = 0; c < data.GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* p = nullptr;
    data.GetCells()->GetCellAtId(c, count, p);
    nodes.assign(p, p + count);
    if (data.GetCellType(c) == VTK_HEXAHEDRON && mesh.add_hexahedron(nodes)) continue;
    const std::optional<Shape> shape = shape_of(data.GetCellType(c));
    const std::int32_t face = ids ? static_cast<std::int32_t>(ids->GetTuple1(c)) : 1;
    mesh.set_in_layers(layer && layer->GetTuple1(c) == 1.0);
    if (!shape || !mesh.add(*shape, nodes, face, vtk_order))
      refuse(path, "cell " + std::to_string(c) + " is of VTK type " + std::to_string(data.GetCellType(c)) +
                       " with " + std::to_string(count) +
                       " points; tetrahedra (10, 24), prisms (13, 32), hexahedra (12), triangles (5, 22) and "
                       "quadrilaterals (9, 28) are read");
  }
  return mesh.finish(mesh.has_boundary() ? faces_of(data, mesh.face_ids()) : std::vector<geometry::Face>());
}

LayeredMesh read_vtu(const fs::path& path) {
  return mesh_of(*read_grid(path), path);
}

namespace {

using MeshReader = LayeredMesh (*)(const fs::path&);

/// Gmsh's and Fluent's files have the same extension; Fluent's is all in brackets.
bool begins_with_bracket(const fs::path& path) {
  std::ifstream in(path);
  char first = 0;
  return (in >> first) && first == '(';
}

/// Nothing for what is no volume mesh.
MeshReader reader_of(const fs::path& path) {
  const fs::path extension = path.extension();
  if (extension == ".vtu") return read_vtu;
  if (extension == ".msh") return begins_with_bracket(path) ? read_fluent : read_gmsh;
  if (extension == ".exo" || extension == ".e" || extension == ".ex2") return read_exodus;
  if (extension == ".inp") return read_abaqus;
  if (extension == ".cgns") return read_cgns;
  if (extension == ".xdmf") return read_xdmf;
  std::error_code error;
  if (!fs::is_directory(path, error)) return nullptr;
  if (!poly_mesh_in(path).empty()) return read_openfoam;
  return fs::exists(path / "mesh.xdmf", error) ? read_xdmf : nullptr;
}

}  // namespace

bool is_volume_mesh(const fs::path& path) {
  return reader_of(path) != nullptr;
}

std::string readable_volume_meshes() {
  return "VTU (.vtu), ASCII Gmsh 2.2 or 4.1 and ASCII Fluent (.msh), Exodus II (.exo), Abaqus (.inp), CGNS "
         "(.cgns), XDMF with "
         "HDF5 (.xdmf), an OpenFOAM case in ASCII (its folder)";
}

MixedMesh read_volume_mesh(const fs::path& path) {
  return read_layered_mesh(path).mesh;
}

LayeredMesh read_layered_mesh(const fs::path& path) {
  const MeshReader reader = reader_of(path);
  return reader ? reader(path) : read_vtu(path);
}

}  // namespace ostia::io
