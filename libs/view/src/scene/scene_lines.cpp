#include "scene/scene_lines.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::view {
namespace {

using geometry::Vec3;

vtkSmartPointer<vtkActor> unlit(vtkPolyData* shape) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shape);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->PickableOff();
  return actor;
}

}  // namespace

vtkSmartPointer<vtkActor> line_actor(std::span<const SceneLine> lines, double width_px) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const SceneLine& line : lines) {
    if (line.points.size() < 2) continue;
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Vec3& point : line.points) points->InsertNextPoint(point.data());
    const auto count = static_cast<vtkIdType>(line.points.size());
    cells->InsertNextCell(static_cast<int>(count) + (line.closed ? 1 : 0));
    for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(first + i);
    if (line.closed) cells->InsertCellPoint(first);
    colors->InsertNextTuple3(255.0 * line.color.r, 255.0 * line.color.g, 255.0 * line.color.b);
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetLines(cells);
  shape->GetCellData()->SetScalars(colors);
  auto actor = unlit(shape);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width_px));
  return actor;
}

vtkSmartPointer<vtkActor> point_actor(std::span<const Vec3> at, const figure::Color& color, double size_px) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Vec3& point : at) {
    const vtkIdType id = points->InsertNextPoint(point.data());
    cells->InsertNextCell(1, &id);
  }
  vtkNew<vtkPolyData> shape;
  shape->SetPoints(points);
  shape->SetVerts(cells);
  auto actor = unlit(shape);
  actor->GetProperty()->SetColor(color.r, color.g, color.b);
  actor->GetProperty()->SetPointSize(static_cast<float>(size_px));
  actor->GetProperty()->RenderPointsAsSpheresOn();
  return actor;
}

void draw_over_all(vtkActor& actor) {
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor.GetMapper());
  // An offset of more than the depth buffer's whole range, in VTK's units of 1.6e-5.
  constexpr double to_the_front = -66000.0;
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, to_the_front);
  mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, to_the_front);
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(to_the_front);
}

void set_font(vtkTextProperty& text, const figure::Color& color, double size_px) {
  text.SetFontFamilyToArial();
  text.SetFontSize(std::max(6, static_cast<int>(std::lround(size_px))));
  text.SetColor(color.r, color.g, color.b);
}

vtkSmartPointer<vtkTextActor> label_actor(const std::string& text, const figure::Color& color,
                                          const figure::Color& plate, double size_px) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  vtkTextProperty* look = actor->GetTextProperty();
  set_font(*look, color, size_px);
  look->SetBackgroundColor(plate.r, plate.g, plate.b);
  look->SetBackgroundOpacity(0.85);
  look->SetVerticalJustificationToBottom();
  actor->PickableOff();
  return actor;
}

std::vector<Vec3> circle(const Vec3& centre, const Vec3& u, const Vec3& v, double radius_mm, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.push_back(centre + radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return points;
}

}  // namespace ostia::view
