#include "scene/scene_corner.h"

#include <vtkCellArray.h>
#include <vtkCoordinate.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTexture.h>
#include <vtkTexturedActor2D.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ostia::view {
namespace {

/// VTK counts rows from below.
vtkSmartPointer<vtkImageData> flipped(const figure::Raster& picture) {
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(picture.width, picture.height, 1);
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetNumberOfComponents(4);
  bytes->SetNumberOfTuples(static_cast<vtkIdType>(picture.width) * picture.height);
  const auto row = static_cast<std::ptrdiff_t>(4) * picture.width;
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.rgba.begin() + row * y, row, bytes->GetPointer(row * (picture.height - 1 - y)));
  image->GetPointData()->SetScalars(bytes);
  return image;
}

vtkSmartPointer<vtkPolyData> quad(double wide, double high) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
    points->InsertNextPoint(x * wide, y * high, 0.0);
    coordinates->InsertNextTuple2(x, y);
  }
  vtkNew<vtkCellArray> cells;
  const std::array<vtkIdType, 4> corners{0, 1, 2, 3};
  cells->InsertNextCell(4, corners.data());
  auto shape = vtkSmartPointer<vtkPolyData>::New();
  shape->SetPoints(points);
  shape->SetPolys(cells);
  shape->GetPointData()->SetTCoords(coordinates);
  return shape;
}

}  // namespace

std::optional<LabelRect> rect_of(vtkTextActor& text, vtkRenderer& renderer, int height_px) {
  if (!text.GetVisibility() || !renderer.GetVTKWindow()) return std::nullopt;
  std::array<double, 4> box{};  // from the text's position
  text.GetBoundingBox(&renderer, box.data());
  const double* at = text.GetPosition();
  const double left = at[0] + box[0], right = at[0] + box[1] + 1.0, low = at[1] + box[2],
               high = at[1] + box[3] + 1.0;
  return LabelRect{{left, height_px - high}, {right - left, high - low}};
}

SceneCorner::SceneCorner(vtkRenderer& renderer) : actor_(vtkSmartPointer<vtkTexturedActor2D>::New()) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(quad(1.0, 1.0));
  actor_->SetMapper(mapper);
  actor_->PickableOff();
  actor_->VisibilityOff();
  renderer.AddViewProp(actor_);
}

void SceneCorner::show(const figure::Raster& picture, std::string text) {
  width_ = picture.width;
  height_ = picture.height;
  text_ = std::move(text);
  rect_.reset();
  actor_->SetVisibility(width_ > 0 && height_ > 0);
  if (!actor_->GetVisibility()) return;
  vtkNew<vtkTexture> texture;
  texture->SetInputData(flipped(picture));
  texture->InterpolateOff();
  texture->RepeatOff();
  texture->SetColorModeToDirectScalars();
  actor_->SetTexture(texture);
  vtkPolyDataMapper2D::SafeDownCast(actor_->GetMapper())->SetInputData(quad(width_, height_));
}

void SceneCorner::lay_out(int left, int low, int height_px) {
  if (!actor_->GetVisibility()) return;
  actor_->SetPosition(left, low);
  rect_ = LabelRect{{double(left), double(height_px - low - height_)}, {double(width_), double(height_)}};
}

}  // namespace ostia::view
