#pragma once
/// \file How far a cloud is from another, both taken for mixtures of Gaussians (Jian and Vemuri 2011).

#include "motion/gauss_sum.h"
#include "motion/kernel_deformation.h"

namespace ostia::experiments {

/// From a fixed cloud to one that moves.
class MixtureDistance {
 public:
  MixtureDistance(MixtureCost cost, std::vector<double> moving_weights, const WeightedCloud& fixed,
                  double width);
  /// With S(a, b) the sums of Gaussians: L2: (S(m, m) - 2 S(m, f) + S(f, f)) / S(f, f); kernel correlation:
  /// 1 - S(m, f)^2 / (S(m, m) S(f, f)). Zero for equal clouds.
  double operator()(const Coordinates& moving, Coordinates& by_points) const;

 private:
  MixtureCost cost_;
  double width_;
  std::vector<double> weights_;
  GaussSum fixed_;
  double own_;  ///< of the fixed cloud with itself
};

}  // namespace ostia::experiments
