#pragma once
/// \file Smoothing of images.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::imaging {

/// The image convolved with a Gaussian of standard deviation `sigma_mm` (>= 0), the same in all directions of
/// the world whatever the spacing; beyond the border the border's value. Separable; along each axis the
/// kernel is the discrete analogue of the Gaussian (T. Lindeberg, IEEE Trans. Pattern Anal. Mach. Intell.
/// 12:234-254, 1990), whose variance is exact for any sigma, small ones included. The same bits for any
/// number of threads. Throws InvalidInput for a sigma that is negative or not finite, Cancelled.
FloatVolume gaussian_blurred(const FloatVolume& image, double sigma_mm,
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
