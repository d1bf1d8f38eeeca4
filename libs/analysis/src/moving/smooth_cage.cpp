#include "moving/smooth_cage.h"

#include <algorithm>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

std::array<double, 4> cubic(double t) {
  const double u = 1.0 - t;
  return {u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
          (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0, t * t * t / 6.0};
}

}  // namespace

SmoothCage::Weights SmoothCage::weights(const Vec3& rest) const {
  Weights result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const double at =
        std::clamp((rest[a] - grid_.origin[a]) / grid_.cell_mm[a], 0.0, static_cast<double>(grid_.cells));
    const int cell = std::min(static_cast<int>(at), grid_.cells - 1);
    result.first[axis] = cell - 1;
    result.along[axis] = cubic(at - cell);
    // A layer of control points outside of the grid goes on linearly from the two inside.
    auto& w = result.along[axis];
    if (cell == 0) {
      w[1] += 2.0 * w[0];
      w[2] -= w[0];
      w[0] = 0.0;
    }
    if (cell == grid_.cells - 1) {
      w[2] += 2.0 * w[3];
      w[1] -= w[3];
      w[3] = 0.0;
    }
  }
  return result;
}

Vec3 SmoothCage::displacement(const Weights& weights, const std::vector<Vec3>& displacements) const {
  const auto inside = [&](int i) { return std::clamp(i, 0, grid_.cells); };  // those outside weigh nothing
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < 4; ++j) {
      const double across = weights.along[2][k] * weights.along[1][j];
      if (across == 0.0) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::int32_t point = grid_.point(inside(weights.first[0] + static_cast<int>(i)),
                                               inside(weights.first[1] + static_cast<int>(j)),
                                               inside(weights.first[2] + static_cast<int>(k)));
        sum += across * weights.along[0][i] * displacements[static_cast<std::size_t>(point)];
      }
    }
  return sum;
}

}  // namespace ostia::analysis
