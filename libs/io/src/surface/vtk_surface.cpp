// Surfaces as VTP, and legacy polydata.

#include "surface_formats.h"
#include "vtk/fields.h"
#include "vtk/xml.h"

#include "ostia/core/files.h"
#include "ostia/io/surface_fields.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace ostia::io {

using geometry::FacedSurface;

namespace {

vtkSmartPointer<vtkPolyData> polydata_of(const FacedSurface& surface) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(to_vtk(surface.mesh.points));
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(static_cast<vtkIdType>(surface.mesh.triangles.size()),
                          static_cast<vtkIdType>(3 * surface.mesh.triangles.size()));
  for (const geometry::Triangle& t : surface.mesh.triangles) polygons->InsertNextCell({t[0], t[1], t[2]});
  data->SetPolys(polygons);
  if (!surface.face_ids.empty()) {
    add_array(*data->GetCellData(), "CellEntityIds", surface.face_ids);
    add_faces(*data, surface.faces);
  }
  return data;
}

/// The faces' numbers under the names that VMTK and SimVascular give them.
vtkDataArray* face_labels(vtkCellData& data) {
  for (const char* name : {"CellEntityIds", "ModelFaceID"})
    if (vtkDataArray* labels = data.GetArray(name); labels && labels->GetNumberOfComponents() == 1)
      return labels;
  return nullptr;
}

}  // namespace

LoadedSurface read_vtp(const std::filesystem::path& path) {
  const vtkSmartPointer<vtkPolyData> data = read_polydata(path);
  LoadedSurface loaded;
  loaded.surface.mesh.points = from_vtk(data->GetPoints());
  vtkDataArray* ids = face_labels(*data->GetCellData());
  if (ids && ids->GetNumberOfTuples() < data->GetNumberOfCells()) ids = nullptr;
  PolydataTriangles found = triangles_of(*data, path);
  if (ids)
    for (const vtkIdType cell : found.cells)
      loaded.surface.face_ids.push_back(static_cast<std::int32_t>(ids->GetTuple1(cell)));
  loaded.surface.mesh.triangles = std::move(found.triangles);
  if (found.polygons > 0)
    loaded.warnings.push_back(std::to_string(found.polygons) + " polygons were split into triangles");
  if (ids) loaded.surface.faces = faces_of(*data, loaded.surface.face_ids, &loaded.warnings);
  return loaded;
}

std::string vtp_text(const FacedSurface& surface) {
  return polydata_text(*polydata_of(surface));
}

void write_vtp_with_fields(const std::filesystem::path& path, const FacedSurface& surface,
                           const PointFields& fields) {
  const vtkSmartPointer<vtkPolyData> data = polydata_of(surface);
  add_fields(*data->GetPointData(), fields, surface.mesh.points.size(), surface.mesh.points.size(), "points");
  core::write_file(path, polydata_text(*data));
}

}  // namespace ostia::io
