#include "motion/mixture_distance.h"

#include <limits>

namespace ostia::experiments {

using geometry::Vec3;

MixtureDistance::MixtureDistance(MixtureCost cost, std::vector<double> moving_weights,
                                 const WeightedCloud& fixed, double width)
    : cost_(cost),
      width_(width),
      weights_(std::move(moving_weights)),
      fixed_(fixed, width),
      own_(fixed_(fixed, nullptr)) {}

double MixtureDistance::operator()(const Coordinates& moving, Coordinates& by_points) const {
  if (!moving.allFinite()) {  // a step much too long: the search shortens it
    by_points = Coordinates::Zero(moving.rows(), 3);
    return std::numeric_limits<double>::infinity();
  }
  WeightedCloud cloud{{}, weights_};
  cloud.points.reserve(weights_.size());
  for (Eigen::Index i = 0; i < moving.rows(); ++i) cloud.points.emplace_back(moving.row(i).transpose());
  std::vector<Vec3> by_self, by_fixed;
  const double self = GaussSum(cloud, width_)(cloud, &by_self), shared = fixed_(cloud, &by_fixed);
  // Of S(m, m) each point has two shares: as one of the first cloud and of the second.
  double of_self = 2.0, of_shared = -2.0, value = (self - 2.0 * shared + own_) / own_;
  if (cost_ == MixtureCost::kernel_correlation) {
    const double share = shared / self;
    value = 1.0 - share * shared / own_;
    of_self = 2.0 * share * share;
    of_shared = -2.0 * share;
  }
  by_points.resize(moving.rows(), 3);
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    by_points.row(static_cast<Eigen::Index>(i)) =
        ((of_self * by_self[i] + of_shared * by_fixed[i]) / own_).transpose();
  return value;
}

}  // namespace ostia::experiments
