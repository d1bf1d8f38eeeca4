#include "lumen/vtk_filters.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDecimatePro.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmoothPolyDataFilter.h>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;

vtkSmartPointer<vtkPolyData> to_vtk(const TriMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), mesh.points[i].data());
  vtkNew<vtkCellArray> cells;
  for (const geometry::Triangle& t : mesh.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

TriMesh from_vtk(vtkPolyData& data) {
  TriMesh mesh;
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    double p[3];
    data.GetPoint(i, p);
    mesh.points.emplace_back(p[0], p[1], p[2]);
  }
  const auto cells = vtk::TakeSmartPointer(data.GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cells->GetCurrentCell(count, ids);
    mesh.triangles.push_back({static_cast<std::int32_t>(ids[0]), static_cast<std::int32_t>(ids[1]),
                              static_cast<std::int32_t>(ids[2])});
  }
  return mesh;
}

}  // namespace

TriMesh decimated_by_vtk(const TriMesh& mesh, double share) {
  vtkNew<vtkDecimatePro> filter;
  filter->SetInputData(to_vtk(mesh));
  filter->SetTargetReduction(share);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return from_vtk(*filter->GetOutput());
}

TriMesh smoothed_by_vtk(const TriMesh& mesh, int iterations, double relaxation) {
  vtkNew<vtkSmoothPolyDataFilter> filter;
  filter->SetInputData(to_vtk(mesh));
  filter->SetNumberOfIterations(iterations);
  filter->SetRelaxationFactor(relaxation);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  return from_vtk(*filter->GetOutput());
}

}  // namespace ostia::experiments
