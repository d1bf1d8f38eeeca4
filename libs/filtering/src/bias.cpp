#include "itk_run.h"

#include "ostia/core/error.h"

#include <itkBSplineControlPointImageFilter.h>
#include <itkN4BiasFieldCorrectionImageFilter.h>
#include <itkShrinkImageFilter.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::filtering::detail {
namespace {

using Correction = itk::N4BiasFieldCorrectionImageFilter<ItkImage, ItkMask, ItkImage>;

/// Where the mask is and the image is above 0, whose logarithm the field is fitted to.
imaging::MaskVolume usable(const Image& image, const Call& call) {
  imaging::MaskVolume mask{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  float least = std::numeric_limits<float>::max(), most = 0.0F;
  std::size_t asked = 0, used = 0;
  for (std::size_t i = 0; i < mask.voxels.size(); ++i) {
    if (call.inputs.mask != nullptr && call.inputs.mask->voxels[i] == 0) continue;
    ++asked;
    if (image.voxels[i] <= 0.0F) continue;
    mask.voxels[i] = 1;
    ++used;
    least = std::min(least, image.voxels[i]);
    most = std::max(most, image.voxels[i]);
  }
  if (used < 64 || used * 100 < asked)
    throw InvalidInput(
        "n4: " + std::to_string(used) + " of " + std::to_string(asked) +
        " voxels are above 0, which is too few; it is for MR, whose values are, or clamp the image "
        "first");
  if (least == most) throw InvalidInput("n4: all values are the same: there is no shading to be seen");
  if (call.inputs.mask != nullptr && used < asked)
    call.warnings.push_back("n4: " + std::to_string(asked - used) +
                            " voxels of the mask are not above 0 and were left out");
  return mask;
}

template <class T>
typename itk::Image<T, 3>::Pointer shrunk(const typename itk::Image<T, 3>::Pointer& image, unsigned factor,
                                          const core::TaskContext& task) {
  auto filter = itk::ShrinkImageFilter<itk::Image<T, 3>, itk::Image<T, 3>>::New();
  filter->SetInput(image);
  for (unsigned a = 0; a < 3; ++a)
    filter->SetShrinkFactor(
        a, std::max(1U, std::min(factor, static_cast<unsigned>(image->GetBufferedRegion().GetSize(a) / 4))));
  run(*filter, task);
  return filter->GetOutput();
}

void tell_options(Correction& correction, const Call& call) {
  const auto levels = static_cast<unsigned>(call.whole("levels"));
  Correction::VariableSizeArrayType iterations(levels);
  iterations.Fill(static_cast<unsigned>(call.whole("iterations")));
  correction.SetMaximumNumberOfIterations(iterations);
  Correction::ArrayType points;
  points.Fill(static_cast<unsigned>(call.whole("control_points")));
  correction.SetNumberOfControlPoints(points);
  correction.SetNumberOfFittingLevels(levels);
  correction.SetNumberOfHistogramBins(static_cast<unsigned>(call.whole("histogram_bins")));
  correction.SetBiasFieldFullWidthAtHalfMaximum(call.number("fwhm"));
  correction.SetWienerFilterNoise(call.number("noise"));
  correction.SetConvergenceThreshold(call.number("tolerance"));
}

/// exp of the field on the image's own voxels divides the image.
Image corrected(const Image& image, Correction& correction, const core::TaskContext& task) {
  using Lattice = Correction::BiasFieldControlPointLatticeType;
  auto field = itk::BSplineControlPointImageFilter<Lattice, Correction::ScalarImageType>::New();
  const auto like = view_of(image);
  field->SetInput(correction.GetLogBiasFieldControlPointLattice());
  field->SetSplineOrder(correction.GetSplineOrder());
  field->SetSize(like->GetLargestPossibleRegion().GetSize());
  field->SetOrigin(like->GetOrigin());
  field->SetSpacing(like->GetSpacing());
  field->SetDirection(like->GetDirection());
  update(*field, task);
  Image out{image.geometry, std::vector<float>(image.voxels.size())};
  const auto* log_field = field->GetOutput()->GetBufferPointer();
  for (std::size_t i = 0; i < out.voxels.size(); ++i)
    out.voxels[i] = static_cast<float>(static_cast<double>(image.voxels[i]) /
                                       std::exp(static_cast<double>(log_field[i][0])));
  return out;
}

}  // namespace

Image n4(const Image& image, const Call& call) {
  const imaging::MaskVolume mask = usable(image, call);
  const auto factor = static_cast<unsigned>(call.whole("shrink"));
  auto correction = Correction::New();
  const auto small = shrunk<float>(view_of(image), factor, call.task.sub(0.0, 0.02));
  const auto small_mask = shrunk<std::uint8_t>(view_of(mask), factor, call.task.sub(0.02, 0.04));
  const std::size_t voxels = small_mask->GetBufferedRegion().GetNumberOfPixels();
  if (std::count(small_mask->GetBufferPointer(), small_mask->GetBufferPointer() + voxels, 1) < 64)
    throw InvalidInput("n4: too few voxels are left by shrink=" + std::to_string(factor) +
                       "; take a smaller one");
  correction->SetInput(small);
  correction->SetMaskImage(small_mask);
  tell_options(*correction, call);
  update(*correction, call.task.sub(0.04, 0.9));
  return corrected(image, *correction, call.task.sub(0.9, 1.0));
}

}  // namespace ostia::filtering::detail
