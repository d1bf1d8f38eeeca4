#pragma once
/// \file Gaussian blur within a slice.

#include "scan/point_spread.h"

#include <array>
#include <vector>

namespace ostia::phantom {

/// Half of a symmetric kernel, the middle first, cut off at 3.3 deviations; its whole sums to 1.
std::vector<double> gaussian_weights(double sigma_voxels);

/// The slice blurred, `width` values a row; beyond the border the border's value.
std::vector<float> blurred(const SliceView& slice, const std::array<double, 2>& sigma_voxels);

}  // namespace ostia::phantom
