#include "scene/flat_surface.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropAssembly.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

unsigned char byte(double component) {
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(component, 0.0, 1.0)));
}

vtkSmartPointer<vtkActor> flat_actor(vtkPolyData* sides) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(sides);
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetInterpolationToFlat();
  look->SetAmbient(0.35);
  look->SetDiffuse(0.65);
  look->SetSpecular(0.0);
  look->SetEdgeColor(0.08, 0.09, 0.11);
  actor->PickableOff();
  actor->VisibilityOff();
  return actor;
}

vtkSmartPointer<vtkPropAssembly> together(vtkActor* surface, vtkActor* lines) {
  auto all = vtkSmartPointer<vtkPropAssembly>::New();
  all->AddPart(surface);
  all->AddPart(lines);
  all->PickableOff();
  return all;
}

}  // namespace

FlatGuest::FlatGuest()
    : sides(vtkSmartPointer<vtkPolyData>::New()), surface(flat_actor(sides)), lines_(line_actor({}, 1.0)) {
  lines_->VisibilityOff();
  all_ = together(surface, lines_);
}

FlatGuest::~FlatGuest() = default;

void FlatGuest::set_lines(std::span<const SceneLine> lines, double width_px) {
  all_->RemovePart(lines_);
  lines_ = line_actor(lines, width_px);
  draw_over_all(*lines_);
  lines_->SetVisibility(!lines.empty());
  all_->AddPart(lines_);
}

vtkProp& FlatGuest::prop() {
  return *all_;
}

vtkSmartPointer<vtkProp> FlatGuest::twin() const {
  auto surface_twin = flat_actor(sides);
  surface_twin->GetProperty()->DeepCopy(surface->GetProperty());
  surface_twin->SetVisibility(surface->GetVisibility());
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->ShallowCopy(lines_->GetMapper());
  auto lines_twin = vtkSmartPointer<vtkActor>::New();
  lines_twin->SetMapper(mapper);
  lines_twin->GetProperty()->DeepCopy(lines_->GetProperty());
  lines_twin->SetVisibility(lines_->GetVisibility());
  return together(surface_twin, lines_twin);
}

void set_flat_points(vtkPolyData& surface, std::span<const geometry::Vec3> points) {
  vtkNew<vtkFloatArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(points.size()));
  float* out = values->GetPointer(0);
  for (const geometry::Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) *out++ = static_cast<float>(point[axis]);
  vtkNew<vtkPoints> all;
  all->SetData(values);
  surface.SetPoints(all);
}

void set_flat_sides(vtkPolyData& surface, std::span<const std::array<std::int32_t, 4>> sides) {
  vtkNew<vtkTypeInt32Array> offsets, corners;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(sides.size() + 1));
  corners->SetNumberOfValues(static_cast<vtkIdType>(4 * sides.size()));
  vtkTypeInt32* offset = offsets->GetPointer(0);
  vtkTypeInt32* corner = corners->GetPointer(0);
  vtkTypeInt32 at = 0;
  for (const auto& side : sides) {
    *offset++ = at;
    for (const std::int32_t one : side)
      if (one >= 0) corner[at++] = one;
  }
  *offset = at;
  corners->SetNumberOfValues(at);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  surface.SetPolys(cells);
}

void set_flat_colors(vtkPolyData& surface, std::span<const figure::Color> colors) {
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetNumberOfComponents(3);
  bytes->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  unsigned char* out = bytes->GetPointer(0);
  for (const figure::Color& color : colors)
    for (const double component : {color.r, color.g, color.b}) *out++ = byte(component);
  surface.GetCellData()->SetScalars(bytes);
  surface.Modified();
}

}  // namespace ostia::view
