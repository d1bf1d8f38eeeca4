#pragma once
/// \file The image as the search for arteries looks at it: smoother where it is noisy, finer where it is
/// coarse.

#include "ostia/core/task_context.h"
#include "ostia/coronary/aorta.h"
#include "ostia/imaging/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::coronary {

struct SearchImage {
  std::optional<imaging::ImageVolume> changed;  ///< nothing: the image itself
  double blur_mm = 0.0;                         ///< added to the scanner's (standard deviation)
  double noise_hu =
      0.0;  ///< in the aorta, voxel by voxel; where it was blurred, what a vessel's width sees of it
  std::vector<std::string> warnings;

  const imaging::ImageVolume& of(const imaging::ImageVolume& image) const {
    return changed ? *changed : image;
  }
};

/// Slices much thicker than the voxels are wide get others between them (cubic); noise that is more than a
/// share of the arteries' contrast is blurred by a Gaussian. Throws Cancelled.
SearchImage search_image(const imaging::ImageVolume& image, const Aorta& aorta,
                         const core::TaskContext& task = core::no_task());

/// Standard deviation of the voxels in the aorta's lumen, from absolute deviations from the median, and the
/// lower quartile over its sections: a flap or a stent in most of them is no noise.
double aortic_noise_hu(const imaging::ImageVolume& image, const Aorta& aorta);

}  // namespace ostia::coronary
