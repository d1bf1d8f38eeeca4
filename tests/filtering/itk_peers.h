#pragma once
/// \file ITK's filters that do what algorithms of ours do, called as a program with ITK alone would call
/// them, on the threads that core allows.

#include "ostia/imaging/volume.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace ostia::filtering::peers {

using imaging::FloatVolume;

/// Gradient or curvature anisotropic diffusion of an image whose spacing is the same along all axes; the
/// contrast in units of the image per mm, a step in mm^2.
FloatVolume itk_diffused(const FloatVolume& image, bool curvature, int steps, double step_mm2,
                         double contrast);

/// -l2 + min(l3, -gap_weight l3) of the Hessian's eigenvalues l1 <= l2 <= l3 at one scale, times e sigma^2; 0
/// where that is negative.
FloatVolume itk_tubeness(const FloatVolume& image, double sigma_mm, double gap_weight);

/// Frangi's measure, the most of several scales (MultiScaleHessianBasedMeasureImageFilter).
FloatVolume itk_vesselness(const FloatVolume& image, double least_sigma_mm, double most_sigma_mm, int scales);

/// Arrival times from some voxels, which start at these times, in a speed image.
FloatVolume itk_marched(const FloatVolume& speed, const std::vector<std::array<std::int64_t, 3>>& seeds,
                        const std::vector<double>& times, double stop = std::numeric_limits<float>::max());

/// The geodesic active contour's level set, negative inside, from `initial`; `edges` near 0 on edges, 1
/// elsewhere. `iterations`: how many it took.
FloatVolume itk_geodesic(const FloatVolume& initial, const FloatVolume& edges, double propagation,
                         double advection, int most_iterations, double most_rms, int& iterations);

}  // namespace ostia::filtering::peers
