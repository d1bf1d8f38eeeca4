#include "itk_run.h"

#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkCurvatureFlowImageFilter.h>
#include <itkGradientAnisotropicDiffusionImageFilter.h>
#include <itkMedianImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <cmath>

namespace ostia::filtering::detail {
namespace {

template <class Filter>
Image smoothed(const Image& image, Filter& filter, const Call& call) {
  filter.SetInput(view_of(image));
  run(filter, call.task);
  return volume_of(*filter.GetOutput(), image.geometry);
}

double least_mm(const Image& image) {
  return image.geometry.spacing.minCoeff();
}

template <class Filter>
Image diffused_by(const Image& image, const Call& call) {
  auto filter = Filter::New();
  filter->SetNumberOfIterations(static_cast<unsigned>(call.whole("steps")));
  // With the spacing heeded these filters divide by it once where the equation does so twice.
  filter->SetTimeStep(call.number("time_step") * least_mm(image));
  filter->SetConductanceParameter(call.number("conductance"));
  filter->SetUseImageSpacing(true);
  return smoothed(image, *filter, call);
}

}  // namespace

Image gaussian(const Image& image, const Call& call) {
  auto filter = itk::SmoothingRecursiveGaussianImageFilter<ItkImage, ItkImage>::New();
  filter->SetSigma(call.number("sigma_mm"));
  filter->SetNormalizeAcrossScale(false);
  return smoothed(image, *filter, call);
}

Image median(const Image& image, const Call& call) {
  auto filter = itk::MedianImageFilter<ItkImage, ItkImage>::New();
  ItkImage::SizeType radius;
  for (unsigned a = 0; a < 3; ++a)
    radius[a] = static_cast<itk::SizeValueType>(
        std::lround(call.number("radius_mm") / image.geometry.spacing[static_cast<int>(a)]));
  filter->SetRadius(radius);
  return smoothed(image, *filter, call);
}

Image curvature_flow(const Image& image, const Call& call) {
  auto filter = itk::CurvatureFlowImageFilter<ItkImage, ItkImage>::New();
  filter->SetNumberOfIterations(static_cast<unsigned>(call.whole("steps")));
  filter->SetTimeStep(call.number("time_step") * least_mm(image) * least_mm(image));
  filter->SetUseImageSpacing(true);
  return smoothed(image, *filter, call);
}

Image gradient_diffusion(const Image& image, const Call& call) {
  return diffused_by<itk::GradientAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>(image, call);
}

Image curvature_diffusion(const Image& image, const Call& call) {
  return diffused_by<itk::CurvatureAnisotropicDiffusionImageFilter<ItkImage, ItkImage>>(image, call);
}

}  // namespace ostia::filtering::detail
