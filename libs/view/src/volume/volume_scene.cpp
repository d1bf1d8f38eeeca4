#include "ostia/view/volume_scene.h"

#include "ostia/core/error.h"

#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
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

constexpr const char* light_array = "light";

/// Colour and opacity by CT number (to the right) and light (upwards). VTK corrects no opacity of such a
/// table for the distance of samples.
vtkSmartPointer<vtkImageData> lit_table(const VolumeTransfer& transfer, const double* hu_range,
                                        const double* light_range, double sample_mm) {
  constexpr int numbers = 1024, lights = 48;
  constexpr double darkest = 0.35, brighter = 1.15;
  auto table = vtkSmartPointer<vtkImageData>::New();
  table->SetDimensions(numbers, lights, 1);
  table->AllocateScalars(VTK_FLOAT, 4);
  for (int x = 0; x < numbers; ++x) {
    const double hu = hu_range[0] + (hu_range[1] - hu_range[0]) * (x + 0.5) / numbers;
    const figure::Color color = color_at(transfer, hu);
    const double opacity = 1.0 - std::pow(1.0 - opacity_at(transfer, hu), sample_mm);
    for (int y = 0; y < lights; ++y) {
      const double light = light_range[0] + (light_range[1] - light_range[0]) * (y + 0.5) / lights;
      const double share = darkest + brighter * std::pow(light, 0.8);
      auto* cell = static_cast<float*>(table->GetScalarPointer(x, y, 0));
      cell[0] = static_cast<float>(std::min(1.0, share * color.r));
      cell[1] = static_cast<float>(std::min(1.0, share * color.g));
      cell[2] = static_cast<float>(std::min(1.0, share * color.b));
      cell[3] = static_cast<float>(opacity);
    }
  }
  return table;
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
      return 2.0;
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
  property_->SetAmbient(0.35);
  property_->SetDiffuse(0.95);
  property_->SetSpecular(0.25);
  property_->SetSpecularPower(24.0);
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
  light_.reset();
  data_ = data;
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

void VolumeScene::set_ambient_light(std::shared_ptr<const std::vector<float>> light) {
  if (light && (!image_ || light->size() != image_->voxels.size()))
    throw InvalidInput("light for " + std::to_string(light->size()) +
                       " voxels was given to a volume that has another number of them");
  if (!image_) return;
  if (light) {
    vtkNew<vtkFloatArray> values;
    values->SetArray(const_cast<float*>(light->data()), static_cast<vtkIdType>(light->size()), 1);
    values->SetName(light_array);
    data_->GetPointData()->AddArray(values);
  } else {
    data_->GetPointData()->RemoveArray(light_array);
  }
  data_->Modified();
  light_ = std::move(light);
  apply_light();
}

void VolumeScene::set_look(const VolumeLook& look) {
  validate(look);
  look_ = look;
  apply_colors();
  apply_light();
}

void VolumeScene::set_crop(const VolumeCrop& crop) {
  validate(crop);
  crop_ = crop;
  apply_crop();
}

std::vector<geometry::Vec3> VolumeScene::corners() const {
  std::vector<geometry::Vec3> result;
  if (!image_) return result;
  const IndexBox box = index_box(crop_, image_->geometry);
  for (int corner = 0; corner < 8; ++corner)
    result.push_back(image_->geometry.world({(corner & 1) != 0 ? box.high.x() : box.low.x(),
                                             (corner & 2) != 0 ? box.high.y() : box.low.y(),
                                             (corner & 4) != 0 ? box.high.z() : box.low.z()}));
  return result;
}

void VolumeScene::copy_from(const VolumeScene& other) {
  set_image(other.image_);
  set_ambient_light(other.light_);
  set_mode(other.mode_);
  set_window(other.level_hu_, other.width_hu_);
  set_look(other.look_);
  set_crop(other.crop_);
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
  property_->SetShade(mode_ == VolumeMode::rendering);
  apply_colors();
  apply_light();
  apply_crop();
}

void VolumeScene::apply_light() {
  if (!image_) return;
  const bool lit = light_ && mode_ == VolumeMode::rendering;
  mapper_->SetTransfer2DYAxisArray(lit ? light_array : nullptr);
  property_->SetTransferFunctionMode(lit ? vtkVolumeProperty::TF_2D : vtkVolumeProperty::TF_1D);
  if (!lit) return;
  double hu_range[2], light_range[2];
  data_->GetPointData()->GetScalars()->GetRange(hu_range);
  data_->GetPointData()->GetArray(light_array)->GetRange(light_range);
  property_->SetTransferFunction2D(lit_table(transfer_of(look_), hu_range, light_range,
                                             static_cast<double>(mapper_->GetSampleDistance())));
}

void VolumeScene::apply_crop() {
  if (!image_) return;
  mapper_->SetCropping(crop_.whole() ? 0 : 1);
  if (crop_.whole()) return;
  const IndexBox box = index_box(crop_, image_->geometry);
  const geometry::Vec3 low = box.low.cwiseProduct(image_->geometry.spacing),
                       high = box.high.cwiseProduct(image_->geometry.spacing);
  mapper_->SetCroppingRegionPlanes(low.x(), high.x(), low.y(), high.y(), low.z(), high.z());
  mapper_->SetCroppingRegionFlagsToSubVolume();
}

/// The MIP in shares of the window.
void VolumeScene::apply_colors() {
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  if (mode_ == VolumeMode::mip) {
    const double low = level_hu_ - 0.5 * width_hu_;
    const auto hu = [&](double share) { return low + share * width_hu_; };
    color->AddRGBPoint(hu(0.0), 0.0, 0.0, 0.0);
    color->AddRGBPoint(hu(1.0), 1.0, 1.0, 1.0);
    opacity->AddPoint(hu(0.15), 0.0);
    opacity->AddPoint(hu(0.5), 0.85);
    opacity->AddPoint(hu(1.0), 1.0);
  } else {
    const VolumeTransfer transfer = transfer_of(look_);
    for (const ColorAtHu& each : transfer.colors)
      color->AddRGBPoint(each.hu, each.color.r, each.color.g, each.color.b);
    for (const OpacityAtHu& each : transfer.opacities) opacity->AddPoint(each.hu, each.opacity);
  }
  property_->SetColor(color);
  property_->SetScalarOpacity(opacity);
}

}  // namespace ostia::view
