#include "ostia/view/volume_scene.h"

#include "ostia/core/error.h"

#include <vtkColorTransferFunction.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::view {
namespace {

/// From millimetres along the image's own axes to the world.
vtkSmartPointer<vtkMatrix4x4> placement(const imaging::Geometry& image) {
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix->SetElement(row, column, image.direction(row, column));
    matrix->SetElement(row, 3, image.origin[row]);
  }
  return matrix;
}

/// VTK's view of the voxels; they are read, never written.
vtkSmartPointer<vtkImageData> view_of(const imaging::ImageVolume& image) {
  auto data = vtkSmartPointer<vtkImageData>::New();
  const imaging::Geometry& g = image.geometry;
  data->SetDimensions(static_cast<int>(g.size[0]), static_cast<int>(g.size[1]), static_cast<int>(g.size[2]));
  data->SetSpacing(g.spacing.x(), g.spacing.y(), g.spacing.z());
  vtkNew<vtkShortArray> voxels;
  voxels->SetArray(const_cast<std::int16_t*>(image.voxels.data()),
                   static_cast<vtkIdType>(image.voxels.size()), 1);
  voxels->SetName("HU");
  data->GetPointData()->SetScalars(voxels);
  return data;
}

void check(const imaging::ImageVolume& image) {
  const auto& size = image.geometry.size;
  if (std::min({size[0], size[1], size[2]}) < 2 || std::max({size[0], size[1], size[2]}) > 4096)
    throw InvalidInput("an image of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                       std::to_string(size[2]) +
                       " voxels cannot be shown in 3D; it takes 2 to 4096 along each axis");
  if (static_cast<std::int64_t>(image.voxels.size()) != image.geometry.voxels())
    throw InvalidInput("the image to be shown in 3D has " + std::to_string(image.voxels.size()) +
                       " voxels, its size says " + std::to_string(image.geometry.voxels()));
}

}  // namespace

double next_level_cost(VolumeQuality quality) {
  switch (quality) {
    case VolumeQuality::hidden:
    case VolumeQuality::full:
      return 1.0;
    case VolumeQuality::coarse:
      return 8.0;
    case VolumeQuality::medium:
      return 4.0;
    case VolumeQuality::fine:
      return 14.0;  // twice the samples, seven look-ups for each
  }
  return 1.0;
}

VolumeQuality finer(VolumeQuality quality) {
  return quality == VolumeQuality::full ? quality : static_cast<VolumeQuality>(static_cast<int>(quality) + 1);
}

VolumeScene::VolumeScene()
    : volume_(vtkSmartPointer<vtkVolume>::New()),
      mapper_(vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New()),
      property_(vtkSmartPointer<vtkVolumeProperty>::New()) {
  property_->SetInterpolationTypeToLinear();
  property_->SetScalarOpacityUnitDistance(1.0);
  property_->SetAmbient(0.4);
  property_->SetDiffuse(0.8);
  property_->SetSpecular(0.1);
  mapper_->AutoAdjustSampleDistancesOff();
  mapper_->SetUseJittering(1);
  volume_->SetProperty(property_);
  volume_->PickableOff();
  apply();
}

VolumeScene::~VolumeScene() = default;

vtkVolume* VolumeScene::prop() const {
  return volume_;
}

void VolumeScene::set_image(std::shared_ptr<const imaging::ImageVolume> image) {
  if (image) check(*image);
  if (image == image_) return;
  vtkSmartPointer<vtkImageData> data;
  if (image) {
    data = view_of(*image);
    volume_->SetUserMatrix(placement(image->geometry));
  }
  mapper_->SetInputData(data);
  volume_->SetMapper(data ? mapper_.Get() : nullptr);
  image_ = std::move(image);  // the former voxels go only now that VTK has let go of them
  apply();
}

void VolumeScene::set_mode(VolumeMode mode) {
  mode_ = mode;
  apply();
}

void VolumeScene::set_window(double level_hu, double width_hu) {
  if (!std::isfinite(level_hu) || !(width_hu > 0.0) || !std::isfinite(width_hu))
    throw InvalidInput("a window of " + std::to_string(width_hu) + " HU about " + std::to_string(level_hu) +
                       " HU cannot be shown; its width has to be above 0");
  level_hu_ = level_hu;
  width_hu_ = width_hu;
  apply_colors();
}

void VolumeScene::set_quality(VolumeQuality quality) {
  quality_ = quality;
  apply();
}

std::vector<geometry::Vec3> VolumeScene::corners() const {
  std::vector<geometry::Vec3> result;
  if (!image_) return result;
  const auto& size = image_->geometry.size;
  for (int corner = 0; corner < 8; ++corner)
    result.push_back(image_->geometry.world({(corner & 1) != 0 ? static_cast<double>(size[0] - 1) : 0.0,
                                             (corner & 2) != 0 ? static_cast<double>(size[1] - 1) : 0.0,
                                             (corner & 4) != 0 ? static_cast<double>(size[2] - 1) : 0.0}));
  return result;
}

void VolumeScene::copy_from(const VolumeScene& other) {
  set_image(other.image_);
  set_mode(other.mode_);
  set_window(other.level_hu_, other.width_hu_);
}

void VolumeScene::apply() {
  volume_->SetVisibility(image_ && mode_ != VolumeMode::off && quality_ != VolumeQuality::hidden);
  if (!image_) return;
  const double voxel = image_->geometry.spacing.minCoeff();
  const double samples = quality_ == VolumeQuality::coarse ? 2.0
                         : quality_ == VolumeQuality::full ? 0.5
                                                           : 1.0;
  const float pixels = quality_ == VolumeQuality::coarse   ? 4.0F
                       : quality_ == VolumeQuality::medium ? 2.0F
                                                           : 1.0F;
  mapper_->SetSampleDistance(static_cast<float>(samples * voxel));
  mapper_->SetImageSampleDistance(pixels);
  if (mode_ == VolumeMode::mip)
    mapper_->SetBlendModeToMaximumIntensity();
  else
    mapper_->SetBlendModeToComposite();
  property_->SetShade(mode_ == VolumeMode::rendering && quality_ == VolumeQuality::full);
  apply_colors();
}

/// In shares of the window, which for CTA (250 +- 400 HU) puts fat below 0.1, muscle at 0.3, contrast at 0.6
/// to 0.8 and calcium above 1.
void VolumeScene::apply_colors() {
  const double low = level_hu_ - 0.5 * width_hu_;
  const auto hu = [&](double share) { return low + share * width_hu_; };
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  if (mode_ == VolumeMode::mip) {
    color->AddRGBPoint(hu(0.0), 0.0, 0.0, 0.0);
    color->AddRGBPoint(hu(1.0), 1.0, 1.0, 1.0);
    opacity->AddPoint(hu(0.15), 0.0);
    opacity->AddPoint(hu(0.5), 0.85);
    opacity->AddPoint(hu(1.0), 1.0);
  } else {
    color->AddRGBPoint(hu(0.15), 0.55, 0.22, 0.16);
    color->AddRGBPoint(hu(0.35), 0.72, 0.32, 0.24);
    color->AddRGBPoint(hu(0.52), 0.90, 0.55, 0.42);
    color->AddRGBPoint(hu(0.75), 1.0, 0.85, 0.72);
    color->AddRGBPoint(hu(1.00), 1.0, 0.97, 0.90);
    color->AddRGBPoint(hu(1.10), 1.0, 1.0, 1.0);
    opacity->AddPoint(hu(0.18), 0.0);
    opacity->AddPoint(hu(0.30), 0.012);
    opacity->AddPoint(hu(0.42), 0.02);
    opacity->AddPoint(hu(0.58), 0.30);
    opacity->AddPoint(hu(1.00), 0.30);
    opacity->AddPoint(hu(1.10), 0.9);
  }
  property_->SetColor(color);
  property_->SetScalarOpacity(opacity);
}

}  // namespace ostia::view
