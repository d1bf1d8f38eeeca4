#include "itk_run.h"

#include <itkFlatStructuringElement.h>
#include <itkGrayscaleDilateImageFilter.h>
#include <itkGrayscaleErodeImageFilter.h>
#include <itkGrayscaleFillholeImageFilter.h>
#include <itkGrayscaleMorphologicalClosingImageFilter.h>
#include <itkGrayscaleMorphologicalOpeningImageFilter.h>

#include <cmath>

namespace ostia::filtering::detail {
namespace {

using Ball = itk::FlatStructuringElement<3>;

Ball ball_of(const imaging::Geometry& grid, double radius_mm) {
  Ball::RadiusType radius;
  for (unsigned a = 0; a < 3; ++a)
    radius[a] = static_cast<itk::SizeValueType>(std::lround(radius_mm / grid.spacing[static_cast<int>(a)]));
  return Ball::Ball(radius);
}

template <class Filter>
Image by_ball(const Image& image, const Call& call) {
  auto filter = Filter::New();
  filter->SetInput(view_of(image));
  filter->SetKernel(ball_of(image.geometry, call.number("radius_mm")));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

}  // namespace

Image erode(const Image& image, const Call& call) {
  return by_ball<itk::GrayscaleErodeImageFilter<ItkImage, ItkImage, Ball>>(image, call);
}
Image dilate(const Image& image, const Call& call) {
  return by_ball<itk::GrayscaleDilateImageFilter<ItkImage, ItkImage, Ball>>(image, call);
}
Image opened(const Image& image, const Call& call) {
  return by_ball<itk::GrayscaleMorphologicalOpeningImageFilter<ItkImage, ItkImage, Ball>>(image, call);
}
Image closed(const Image& image, const Call& call) {
  return by_ball<itk::GrayscaleMorphologicalClosingImageFilter<ItkImage, ItkImage, Ball>>(image, call);
}

Image fill_holes(const Image& image, const Call& call) {
  auto filter = itk::GrayscaleFillholeImageFilter<ItkImage, ItkImage>::New();
  filter->SetInput(view_of(image));
  run(*filter, call.task);
  return volume_of(*filter->GetOutput(), image.geometry);
}

}  // namespace ostia::filtering::detail
