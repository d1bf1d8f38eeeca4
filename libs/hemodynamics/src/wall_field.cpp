#include "wall_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ostia::hemodynamics {

WallField::WallField(const Network& network, double correlation_mm) {
  std::vector<long> last(network.branches.size(), -1);  // of each branch: its last station
  for (std::size_t b = 0; b < network.branches.size(); ++b) {
    const Branch& branch = network.branches[b];
    long before = branch.parent < 0 ? -1 : last[static_cast<std::size_t>(branch.parent)];
    for (std::size_t i = 0; i < branch.stations.size(); ++i) {
      Step step;
      step.before = before;
      // What lies within the parent's lumen is no way: there the walls are one.
      const double way = i == 0 ? 0.0 : branch.stations[i].s_mm - branch.stations[i - 1].s_mm;
      if (before >= 0) {
        const double a = std::numbers::sqrt3 * way / correlation_mm, decay = std::exp(-a);
        step.z_by_z = decay * (1.0 + a), step.z_by_slope = decay * a;
        step.slope_by_z = -decay * a, step.slope_by_slope = decay * (1.0 - a);
        const double zz = 1.0 - step.z_by_z * step.z_by_z - step.z_by_slope * step.z_by_slope;
        const double zs = -step.z_by_z * step.slope_by_z - step.z_by_slope * step.slope_by_slope;
        const double ss = 1.0 - step.slope_by_z * step.slope_by_z - step.slope_by_slope * step.slope_by_slope;
        step.z_new = std::sqrt(std::max(0.0, zz));
        step.slope_by_first = step.z_new > 1e-9 ? zs / step.z_new : 0.0;
        step.slope_new = std::sqrt(std::max(0.0, ss - step.slope_by_first * step.slope_by_first));
      }
      before = static_cast<long>(steps_.size());
      steps_.push_back(step);
    }
    last[b] = before;
  }
}

void WallField::values(std::span<const double> independent, std::span<double> values) const {
  std::vector<double> slope(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    double z = step.z_new * independent[2 * i];
    double dz = step.slope_by_first * independent[2 * i] + step.slope_new * independent[2 * i + 1];
    if (step.before >= 0) {
      const auto k = static_cast<std::size_t>(step.before);
      z += step.z_by_z * values[k] + step.z_by_slope * slope[k];
      dz += step.slope_by_z * values[k] + step.slope_by_slope * slope[k];
    }
    values[i] = z;
    slope[i] = dz;
  }
}

std::vector<double> WallField::influence(std::span<const double> weights) const {
  std::vector<double> by_z(weights.begin(), weights.end()), by_slope(steps_.size(), 0.0);
  std::vector<double> out(innovations());
  for (std::size_t i = steps_.size(); i-- > 0;) {
    const Step& step = steps_[i];
    out[2 * i] = step.z_new * by_z[i] + step.slope_by_first * by_slope[i];
    out[2 * i + 1] = step.slope_new * by_slope[i];
    if (step.before < 0) continue;
    const auto k = static_cast<std::size_t>(step.before);
    by_z[k] += step.z_by_z * by_z[i] + step.slope_by_z * by_slope[i];
    by_slope[k] += step.z_by_slope * by_z[i] + step.slope_by_slope * by_slope[i];
  }
  return out;
}

EvenDirections::EvenDirections(const std::vector<std::vector<double>>& influences) {
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  for (std::vector<double> one : influences) {
    const double whole = std::sqrt(dot(one, one));
    for (int again = 0; again < 2; ++again)
      for (const std::vector<double>& other : directions_) {
        const double part = dot(one, other);
        for (std::size_t i = 0; i < one.size(); ++i) one[i] -= part * other[i];
      }
    const double left = std::sqrt(dot(one, one));
    if (!(left > 1e-3 * whole)) continue;  // the others say it already
    for (double& value : one) value /= left;
    directions_.push_back(std::move(one));
  }
}

void EvenDirections::put(std::span<const double> even, std::span<double> independent) const {
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const std::vector<double>& direction = directions_[k];
    const double part =
        even[k] - std::inner_product(direction.begin(), direction.end(), independent.begin(), 0.0);
    for (std::size_t i = 0; i < direction.size(); ++i) independent[i] += part * direction[i];
  }
}

}  // namespace ostia::hemodynamics
