#include "ostia/io/volume_mesh_file.h"

#include "formats.h"
#include "vtk_xml.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::VolumeMesh;

void write_volume_mesh(const fs::path& path, const VolumeMesh& mesh) {
  if (path.extension() != ".vtu")
    throw InvalidInput("cannot write " + path.string() + ": a volume mesh is written as .vtu");
  vtkNew<vtkUnstructuredGrid> data;
  data->SetPoints(to_vtk(mesh.points));
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkCellArray> cells;
  std::vector<std::int32_t> ids;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    cells->InsertNextCell({t[0], t[1], t[2], t[3]});
    types->InsertNextValue(VTK_TETRA);
    ids.push_back(0);
  }
  for (std::size_t i = 0; i < mesh.boundary.size(); ++i) {
    const geometry::Triangle& t = mesh.boundary[i];
    cells->InsertNextCell({t[0], t[1], t[2]});
    types->InsertNextValue(VTK_TRIANGLE);
    ids.push_back(mesh.boundary_face_ids[i]);
  }
  data->SetCells(types, cells);
  add_array(*data->GetCellData(), "CellEntityIds", ids);
  add_faces(*data, mesh.faces);
  core::write_file(path, grid_text(*data));
}

VolumeMesh read_volume_mesh(const fs::path& path) {
  const vtkSmartPointer<vtkUnstructuredGrid> data = read_grid(path);
  VolumeMesh mesh;
  mesh.points = from_vtk(data->GetPoints());
  vtkDataArray* ids = data->GetCellData()->GetArray("CellEntityIds");
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* p = nullptr;
    data->GetCells()->GetCellAtId(c, count, p);
    const int type = data->GetCellType(c);
    const auto point = [p](vtkIdType i) { return static_cast<std::int32_t>(p[i]); };
    if (type == VTK_TETRA && count == 4) {
      mesh.tetrahedra.push_back({point(0), point(1), point(2), point(3)});
    } else if (type == VTK_TRIANGLE && count == 3) {
      mesh.boundary.push_back({point(0), point(1), point(2)});
      mesh.boundary_face_ids.push_back(ids ? static_cast<std::int32_t>(ids->GetTuple1(c)) : 1);
    } else {
      refuse(path, "cell " + std::to_string(c) + " is of VTK type " + std::to_string(type) + " with " +
                       std::to_string(count) + " points; linear tetrahedra (10) and triangles (5) are read");
    }
  }
  mesh.faces = faces_of(*data, mesh.boundary_face_ids);
  return mesh;
}

}  // namespace ostia::io
