#pragma once
/// \file One step on its way into ITK. Private to the room.

#include "ostia/filtering/filter.h"

namespace ostia::filtering::detail {

/// What a filter's function is given.
struct Call {
  const FilterStep& step;
  const FilterInputs& inputs;
  core::TaskContext task;
  std::vector<std::string>& warnings;

  double number(std::string_view parameter) const { return value_of(step, parameter); }
  int whole(std::string_view parameter) const { return static_cast<int>(number(parameter)); }
  /// The word that a parameter is.
  std::string word(std::string_view parameter) const;
};

using Image = imaging::FloatVolume;

// One for each filter: the image after it.
Image gaussian(const Image& image, const Call& call);
Image median(const Image& image, const Call& call);
Image curvature_flow(const Image& image, const Call& call);
Image gradient_diffusion(const Image& image, const Call& call);
Image curvature_diffusion(const Image& image, const Call& call);
Image n4(const Image& image, const Call& call);
Image objectness(const Image& image, const Call& call);
Image gradient_magnitude(const Image& image, const Call& call);
Image threshold(const Image& image, const Call& call);
Image otsu(const Image& image, const Call& call);
Image erode(const Image& image, const Call& call);
Image dilate(const Image& image, const Call& call);
Image opened(const Image& image, const Call& call);
Image closed(const Image& image, const Call& call);
Image fill_holes(const Image& image, const Call& call);
Image components(const Image& image, const Call& call);
Image distance(const Image& image, const Call& call);
Image resample(const Image& image, const Call& call);
Image match_histogram(const Image& image, const Call& call);
Image clamp(const Image& image, const Call& call);
Image rescale(const Image& image, const Call& call);

/// Where `resample` puts its voxels: the image's outer faces on three sides stay where they are.
imaging::Geometry resampled_grid(const imaging::Geometry& grid, double spacing_mm);

}  // namespace ostia::filtering::detail
