#include "scene/wall_actor.h"

#include "ostia/core/parallel.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::view {
namespace {

constexpr std::size_t wall_grain = 8192;

vtkSmartPointer<vtkPolyDataMapper> mapper_of(vtkPolyData* surface) {
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(surface);
  mapper->SetColorModeToDirectScalars();
  mapper->SetScalarModeToUsePointData();
  return mapper;
}

std::uint8_t color_byte(double component) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(component, 0.0, 1.0)));
}

}  // namespace

WallActor::WallActor()
    : actor_(vtkSmartPointer<vtkActor>::New()),
      surface_(vtkSmartPointer<vtkPolyData>::New()),
      points_(vtkSmartPointer<vtkFloatArray>::New()),
      normals_(vtkSmartPointer<vtkFloatArray>::New()),
      colors_(vtkSmartPointer<vtkUnsignedCharArray>::New()),
      offsets_(vtkSmartPointer<vtkTypeInt32Array>::New()),
      corners_(vtkSmartPointer<vtkTypeInt32Array>::New()),
      cells_(vtkSmartPointer<vtkCellArray>::New()) {
  points_->SetNumberOfComponents(3);
  normals_->SetNumberOfComponents(3);
  colors_->SetNumberOfComponents(3);
  colors_->SetName("colors");
  vtkNew<vtkPoints> points;
  points->SetData(points_);
  surface_->SetPoints(points);
  surface_->SetPolys(cells_);
  surface_->GetPointData()->SetNormals(normals_);
  surface_->GetPointData()->SetScalars(colors_);
  actor_->SetMapper(mapper_of(surface_));
  vtkProperty* look = actor_->GetProperty();
  look->SetInterpolationToPhong();
  look->SetAmbient(0.18);
  look->SetDiffuse(0.82);
  look->SetSpecular(0.25);
  look->SetSpecularPower(25.0);
  actor_->PickableOff();
  actor_->VisibilityOff();
}

WallActor::~WallActor() = default;

vtkActor* WallActor::prop() const {
  return actor_;
}

vtkSmartPointer<vtkActor> WallActor::twin() const {
  auto twin = vtkSmartPointer<vtkActor>::New();
  twin->SetMapper(mapper_of(surface_));
  twin->GetProperty()->DeepCopy(actor_->GetProperty());
  twin->SetVisibility(actor_->GetVisibility());
  return twin;
}

void WallActor::set_points(const geometry::TriMesh& mesh, const std::vector<Eigen::Vector3f>& normals) {
  const std::size_t count = mesh.points.size();
  points_->SetNumberOfTuples(static_cast<vtkIdType>(count));
  normals_->SetNumberOfTuples(static_cast<vtkIdType>(count));
  float* point = points_->GetPointer(0);
  for (std::size_t i = 0; i < count; ++i)
    for (int a = 0; a < 3; ++a)
      point[3 * i + static_cast<std::size_t>(a)] = static_cast<float>(mesh.points[i][a]);
  std::copy_n(reinterpret_cast<const float*>(normals.data()), 3 * count, normals_->GetPointer(0));
  points_->Modified();
  normals_->Modified();
  surface_->GetPoints()->Modified();
}

void WallActor::set_triangles(const geometry::TriMesh& mesh,
                              const std::function<bool(std::size_t)>& visible) {
  corners_->SetNumberOfValues(static_cast<vtkIdType>(3 * mesh.triangles.size()));
  vtkTypeInt32* corner = corners_->GetPointer(0);
  vtkIdType kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!visible(i)) continue;
    const geometry::Triangle& t = mesh.triangles[i];
    std::copy(t.begin(), t.end(), corner + 3 * kept);
    ++kept;
  }
  take_corners(kept);
}

void WallActor::keep_triangles(const std::function<bool(const geometry::Triangle&)>& wanted) {
  vtkTypeInt32* corner = corners_->GetPointer(0);
  const vtkIdType count = corners_->GetNumberOfValues() / 3;
  vtkIdType kept = 0;
  for (vtkIdType i = 0; i < count; ++i) {
    const geometry::Triangle t{corner[3 * i], corner[3 * i + 1], corner[3 * i + 2]};
    if (!wanted(t)) continue;
    std::copy(t.begin(), t.end(), corner + 3 * kept);
    ++kept;
  }
  take_corners(kept);
}

/// The first ones in the array are the triangles from now on.
void WallActor::take_corners(vtkIdType kept) {
  corners_->SetNumberOfValues(3 * kept);
  if (offsets_->GetNumberOfValues() != kept + 1) {
    offsets_->SetNumberOfValues(kept + 1);
    vtkTypeInt32* offset = offsets_->GetPointer(0);
    for (vtkIdType i = 0; i <= kept; ++i) offset[i] = static_cast<vtkTypeInt32>(3 * i);
  }
  corners_->Modified();
  cells_->SetData(offsets_, corners_);
  cells_->Modified();
  surface_->Modified();
  actor_->SetVisibility(kept > 0 && !hidden_);
}

void WallActor::set_hidden(bool hidden) {
  hidden_ = hidden;
  actor_->SetVisibility(corners_->GetNumberOfValues() > 0 && !hidden_);
}

void WallActor::set_colors(std::size_t count, const std::function<figure::Color(std::size_t)>& color_of) {
  colors_->SetNumberOfTuples(static_cast<vtkIdType>(count));
  unsigned char* out = colors_->GetPointer(0);
  core::parallel_for(count, wall_grain, [&](std::size_t i) {
    const figure::Color color = color_of(i);
    out[3 * i] = color_byte(color.r);
    out[3 * i + 1] = color_byte(color.g);
    out[3 * i + 2] = color_byte(color.b);
  });
  colors_->Modified();
  surface_->Modified();
}

void WallActor::set_opacity(double opacity) {
  actor_->GetProperty()->SetOpacity(opacity);
  // Of a closed surface that lets light through the near side alone is drawn: the order of triangles does not
  // show, and what is inside is seen through one layer.
  actor_->GetProperty()->SetBackfaceCulling(opacity < 1.0);
}

void WallActor::clear() {
  set_points({}, {});
  set_triangles({}, [](std::size_t) { return true; });
  set_colors(0, [](std::size_t) { return figure::Color{}; });
}

}  // namespace ostia::view
