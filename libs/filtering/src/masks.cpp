#include "itk_run.h"

#include "ostia/core/error.h"

#include <itkBinaryThresholdImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkOtsuMultipleThresholdsImageFilter.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>

namespace ostia::filtering::detail {
namespace {

using Numbers = itk::Image<std::uint32_t, 3>;

imaging::MaskVolume not_zero(const Image& image) {
  imaging::MaskVolume mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  std::transform(image.voxels.begin(), image.voxels.end(), mask.voxels.begin(),
                 [](float v) { return static_cast<std::uint8_t>(v != 0.0F); });
  return mask;
}

}  // namespace

Image threshold(const Image& image, const Call& call) {
  auto filter = itk::BinaryThresholdImageFilter<ItkImage, ItkMask>::New();
  filter->SetInput(view_of(image));
  filter->SetLowerThreshold(static_cast<float>(call.number("lower")));
  filter->SetUpperThreshold(static_cast<float>(call.number("upper")));
  filter->SetInsideValue(1);
  filter->SetOutsideValue(0);
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

Image otsu(const Image& image, const Call& call) {
  const auto [least, most] = std::minmax_element(image.voxels.begin(), image.voxels.end());
  if (*least == *most) throw InvalidInput("otsu: all values are the same: there are no classes");
  auto filter = itk::OtsuMultipleThresholdsImageFilter<ItkImage, ItkMask>::New();
  filter->SetInput(view_of(image));
  filter->SetNumberOfThresholds(static_cast<unsigned>(call.whole("classes") - 1));
  filter->SetNumberOfHistogramBins(static_cast<unsigned>(call.whole("histogram_bins")));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

Image components(const Image& image, const Call& call) {
  const imaging::MaskVolume mask = not_zero(image);
  auto parts = itk::ConnectedComponentImageFilter<ItkMask, Numbers>::New();
  parts->SetInput(view_of(mask));
  parts->SetFullyConnected(call.word("corners") == "yes");
  run(*parts, call.task.sub(0.0, 0.6));
  auto ordered = itk::RelabelComponentImageFilter<Numbers, Numbers>::New();
  ordered->SetInput(parts->GetOutput());
  ordered->SetMinimumObjectSize(static_cast<itk::SizeValueType>(call.whole("least_voxels")));
  run(*ordered, call.task.sub(0.6, 1.0));
  const auto most = static_cast<std::uint32_t>(call.whole("most"));
  const std::uint32_t* label = ordered->GetOutput()->GetBufferPointer();
  Image out{image.geometry, std::vector<float>(image.voxels.size())};
  for (std::size_t i = 0; i < out.voxels.size(); ++i)
    out.voxels[i] = label[i] <= most ? static_cast<float>(label[i]) : 0.0F;
  const auto left = ordered->GetNumberOfObjects();
  if (left > most)
    call.warnings.push_back("components: " + std::to_string(left - most) + " of " + std::to_string(left) +
                            " parts, the smallest, were left out (most=" + std::to_string(most) + ")");
  return out;
}

Image distance(const Image& image, const Call& call) {
  const imaging::MaskVolume mask = not_zero(image);
  if (std::count(mask.voxels.begin(), mask.voxels.end(), 0) ==
          static_cast<std::ptrdiff_t>(mask.voxels.size()) ||
      std::count(mask.voxels.begin(), mask.voxels.end(), 0) == 0)
    throw InvalidInput("distance: the image is 0 everywhere or nowhere: there is no border");
  auto filter = itk::SignedMaurerDistanceMapImageFilter<ItkMask, ItkImage>::New();
  filter->SetInput(view_of(mask));
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

}  // namespace ostia::filtering::detail
