#include "itk_run.h"

#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkHessianRecursiveGaussianImageFilter.h>
#include <itkHessianToObjectnessMeasureImageFilter.h>

#include <algorithm>
#include <cmath>

namespace ostia::filtering::detail {
namespace {

using Tensors = itk::Image<itk::SymmetricSecondRankTensor<float, 3>, 3>;

double scale_mm(const Call& call, int n) {
  const double least = call.number("sigma_least_mm"), most = call.number("sigma_most_mm");
  const int last = call.whole("scales") - 1;
  return last == 0 ? least : least * std::pow(most / least, static_cast<double>(n) / last);
}

/// One scale's answer.
ItkImage::Pointer answer(const Image& image, double sigma_mm, const Call& call,
                         const core::TaskContext& task) {
  auto hessian = itk::HessianRecursiveGaussianImageFilter<ItkImage, Tensors>::New();
  hessian->SetInput(view_of(image));
  hessian->SetSigma(sigma_mm);
  hessian->SetNormalizeAcrossScale(true);
  run(*hessian, task.sub(0.0, 0.6));
  auto measure = itk::HessianToObjectnessMeasureImageFilter<Tensors, ItkImage>::New();
  measure->SetInput(hessian->GetOutput());
  const std::string object = call.word("object");
  measure->SetObjectDimension(object == "blob" ? 0 : object == "tube" ? 1 : 2);
  measure->SetBrightObject(call.word("bright") == "yes");
  measure->SetScaleObjectnessMeasure(true);
  measure->SetAlpha(call.number("alpha"));
  measure->SetBeta(call.number("beta"));
  measure->SetGamma(call.number("gamma"));
  run(*measure, task.sub(0.6, 1.0));
  ItkImage::Pointer result = measure->GetOutput();
  result->DisconnectPipeline();
  return result;
}

}  // namespace

Image objectness(const Image& image, const Call& call) {
  Image out{image.geometry, std::vector<float>(image.voxels.size(), 0.0F)};
  const int scales = call.whole("scales");
  for (int n = 0; n < scales; ++n) {
    const auto task = call.task.sub(static_cast<double>(n) / scales, static_cast<double>(n + 1) / scales);
    const auto now = answer(image, scale_mm(call, n), call, task);
    const float* value = now->GetBufferPointer();
    for (std::size_t i = 0; i < out.voxels.size(); ++i) out.voxels[i] = std::max(out.voxels[i], value[i]);
  }
  return out;
}

Image gradient_magnitude(const Image& image, const Call& call) {
  auto filter = itk::GradientMagnitudeRecursiveGaussianImageFilter<ItkImage, ItkImage>::New();
  filter->SetInput(view_of(image));
  filter->SetSigma(call.number("sigma_mm"));
  filter->SetNormalizeAcrossScale(false);
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

}  // namespace ostia::filtering::detail
