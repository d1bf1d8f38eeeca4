#pragma once
/// \file Sums of Gaussians of all distances between two clouds of points.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <vector>

namespace ostia::experiments {

struct WeightedCloud {
  std::vector<geometry::Vec3> points;
  std::vector<double> weights;
};

/// The correlation of two mixtures of Gaussians of one width s: with the clouds' weights, the sum of
/// exp(-d^2 / 4 s^2) - exp(-9) over all pairs nearer than 6 s, which is continuous there.
class GaussSum {
 public:
  GaussSum(const WeightedCloud& cloud, double width);
  /// With another cloud. `by_points`, if not null: its derivatives by that cloud's points.
  double operator()(const WeightedCloud& other, std::vector<geometry::Vec3>* by_points) const;

 private:
  std::array<int, 3> cell(const geometry::Vec3& p) const;
  std::size_t start(const std::array<int, 3>& cell) const;
  double width_, reach_;
  geometry::Vec3 low_ = geometry::Vec3::Zero();
  std::array<int, 3> cells_{};
  std::vector<std::uint32_t> starts_;  ///< of each cell, x fastest, and the end
  WeightedCloud sorted_;               ///< by cells
};

/// Points of which no two are nearer than `spacing`, as they come; each has the weight of those that it is
/// nearest to, all weights together are 1. `kept`: their numbers.
WeightedCloud thinned(const std::vector<geometry::Vec3>& points, double spacing,
                      std::vector<std::size_t>& kept);

}  // namespace ostia::experiments
