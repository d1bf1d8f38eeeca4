#include "itk_peers.h"

#include "itk_peer_image.h"

#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkGradientAnisotropicDiffusionImageFilter.h>
#include <itkHessianRecursiveGaussianImageFilter.h>
#include <itkHessianToObjectnessMeasureImageFilter.h>
#include <itkMultiScaleHessianBasedMeasureImageFilter.h>

#include <cmath>

namespace ostia::filtering::peers {
namespace {

using Tensor = itk::SymmetricSecondRankTensor<float, 3>;
using Tensors = itk::Image<Tensor, 3>;

template <class Filter>
FloatVolume diffused_by(const FloatVolume& image, int steps, double step_mm2, double contrast) {
  auto filter = Filter::New();
  filter->InPlaceOff();
  filter->SetInput(lent(image));
  filter->SetNumberOfIterations(static_cast<unsigned>(steps));
  filter->SetUseImageSpacing(true);
  // It divides by the spacing once where the equation does so twice.
  filter->SetTimeStep(step_mm2 / image.geometry.spacing.minCoeff());
  filter->SetConductanceParameter(1.0);
  filter->SetFixedAverageGradientMagnitude(contrast);
  filter->Update();
  return taken(*filter->GetOutput(), image.geometry);
}

}  // namespace

FloatVolume itk_diffused(const FloatVolume& image, bool curvature, int steps, double step_mm2,
                         double contrast) {
  use_our_number_of_threads();
  return curvature ? diffused_by<itk::CurvatureAnisotropicDiffusionImageFilter<PeerImage, PeerImage>>(
                         image, steps, step_mm2, contrast)
                   : diffused_by<itk::GradientAnisotropicDiffusionImageFilter<PeerImage, PeerImage>>(
                         image, steps, step_mm2, contrast);
}

FloatVolume itk_tubeness(const FloatVolume& image, double sigma_mm, double gap_weight) {
  use_our_number_of_threads();
  auto hessian = itk::HessianRecursiveGaussianImageFilter<PeerImage, Tensors>::New();
  hessian->SetInput(lent(image));
  hessian->SetSigma(sigma_mm);
  hessian->Update();
  const Tensor* tensor = hessian->GetOutput()->GetBufferPointer();
  FloatVolume out{image.geometry, std::vector<float>(image.voxels.size())};
  const double scale = std::exp(1.0) * sigma_mm * sigma_mm;
  for (std::size_t i = 0; i < out.voxels.size(); ++i) {
    Tensor::EigenValuesArrayType l;
    tensor[i].ComputeEigenValues(l);  // ascending
    const double answer = scale * (-l[1] + std::min<double>(l[2], -gap_weight * static_cast<double>(l[2])));
    out.voxels[i] = static_cast<float>(std::max(0.0, answer));
  }
  return out;
}

FloatVolume itk_vesselness(const FloatVolume& image, double least_sigma_mm, double most_sigma_mm,
                           int scales) {
  use_our_number_of_threads();
  using Measure = itk::HessianToObjectnessMeasureImageFilter<Tensors, PeerImage>;
  auto measure = Measure::New();
  measure->SetObjectDimension(1);
  auto filter = itk::MultiScaleHessianBasedMeasureImageFilter<PeerImage, Tensors, PeerImage>::New();
  filter->SetInput(lent(image));
  filter->SetHessianToMeasureFilter(measure);
  filter->SetSigmaMinimum(least_sigma_mm);
  filter->SetSigmaMaximum(most_sigma_mm);
  filter->SetNumberOfSigmaSteps(static_cast<unsigned>(scales));
  filter->Update();
  return taken(*filter->GetOutput(), image.geometry);
}

}  // namespace ostia::filtering::peers
