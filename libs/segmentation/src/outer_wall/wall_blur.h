#pragma once
/// \file How blurred an image's walls are along each of its axes.

#include "ostia/imaging/volume.h"

#include <cstdint>
#include <vector>

namespace ostia::segmentation::detail {

using geometry::Vec3;

/// Variances (mm^2) of the blur along the image's axes, of the image as its cubic B-spline shows it, read off
/// the walls near `voxels` of `grid`, a part of the image's: across a wall blurred by a Gaussian log |grad I|
/// is a parabola of curvature -1/s, s = n . S n, and S = diag(variances) is fitted to the walls of all
/// directions, robustly. No less than the spline's own h^2/3. Ones where there are too few walls to tell, or
/// where the three differ by less than the fit can say: only ratios matter to EdgeFeature::blur.
Vec3 wall_blur(const imaging::ImageVolume& image, const imaging::Geometry& grid,
               const std::vector<std::int64_t>& voxels);

}  // namespace ostia::segmentation::detail
