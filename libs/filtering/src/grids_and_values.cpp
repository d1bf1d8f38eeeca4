#include "itk_run.h"

#include "ostia/core/error.h"

#include <itkBSplineInterpolateImageFunction.h>
#include <itkClampImageFilter.h>
#include <itkHistogramMatchingImageFilter.h>
#include <itkIdentityTransform.h>
#include <itkNearestNeighborInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>
#include <itkRescaleIntensityImageFilter.h>

#include <algorithm>
#include <cmath>

namespace ostia::filtering::detail {
namespace {

using Resampling = itk::ResampleImageFilter<ItkImage, ItkImage>;

void set_interpolation(Resampling& filter, const std::string& by) {
  if (by == "nearest") {
    filter.SetInterpolator(itk::NearestNeighborInterpolateImageFunction<ItkImage, double>::New());
  } else if (by == "bspline") {
    filter.SetInterpolator(itk::BSplineInterpolateImageFunction<ItkImage, double, float>::New());
  }  // linear is its own
}

void require_contrast(const Image& image, const std::string& what) {
  const auto [least, most] = std::minmax_element(image.voxels.begin(), image.voxels.end());
  if (*least == *most) throw InvalidInput(what + ": all values are the same");
}

}  // namespace

imaging::Geometry resampled_grid(const imaging::Geometry& grid, double spacing_mm) {
  imaging::Geometry to = grid;
  for (int a = 0; a < 3; ++a)
    to.size[a] = std::max<std::int64_t>(
        1, std::llround(static_cast<double>(grid.size[a]) * grid.spacing[a] / spacing_mm));
  to.spacing = imaging::Vec3::Constant(spacing_mm);
  to.origin = grid.origin + grid.direction * (0.5 * (to.spacing - grid.spacing));
  return to;
}

Image resample(const Image& image, const Call& call) {
  const imaging::Geometry to = resampled_grid(image.geometry, call.number("spacing_mm"));
  auto like = ItkImage::New();
  set_grid(*like, to);
  auto filter = Resampling::New();
  filter->SetInput(view_of(image));
  filter->SetTransform(itk::IdentityTransform<double, 3>::New());
  filter->SetOutputParametersFromImage(like);
  // Where the last voxel reaches beyond the image, up to half a voxel.
  filter->SetExtrapolator(nullptr);
  filter->SetDefaultPixelValue(*std::min_element(image.voxels.begin(), image.voxels.end()));
  set_interpolation(*filter, call.word("by"));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), to);
}

Image match_histogram(const Image& image, const Call& call) {
  require_contrast(image, "match-histogram: the image");
  require_contrast(*call.inputs.reference, "match-histogram: the reference");
  auto filter = itk::HistogramMatchingImageFilter<ItkImage, ItkImage>::New();
  filter->SetSourceImage(view_of(image));
  filter->SetReferenceImage(view_of(*call.inputs.reference));
  filter->SetNumberOfHistogramLevels(static_cast<itk::SizeValueType>(call.whole("levels")));
  filter->SetNumberOfMatchPoints(static_cast<itk::SizeValueType>(call.whole("points")));
  filter->SetThresholdAtMeanIntensity(call.word("above_mean") == "yes");
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

Image clamp(const Image& image, const Call& call) {
  auto filter = itk::ClampImageFilter<ItkImage, ItkImage>::New();
  filter->SetInput(view_of(image));
  filter->SetBounds(static_cast<float>(call.number("lower")), static_cast<float>(call.number("upper")));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

Image rescale(const Image& image, const Call& call) {
  require_contrast(image, "rescale");
  auto filter = itk::RescaleIntensityImageFilter<ItkImage, ItkImage>::New();
  filter->SetInput(view_of(image));
  filter->SetOutputMinimum(static_cast<float>(call.number("lower")));
  filter->SetOutputMaximum(static_cast<float>(call.number("upper")));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

}  // namespace ostia::filtering::detail
