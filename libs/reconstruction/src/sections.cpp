#include "ostia/reconstruction/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::reconstruction {
namespace {

/// The weight w of eq. 2, linear between its samples.
class Weight {
 public:
  Weight(const std::vector<double>& at, const std::vector<double>& radii,
         const std::vector<double>& curvatures, double bending)
      : at_(at), values_(at.size()) {
    for (std::size_t i = 0; i < at.size(); ++i)
      values_[i] = radii[i] / (1.0 + bending * radii[i] * curvatures[i]);
  }
  /// The least root y > x of y - x - a (w(x) + w(y)), which is linear from sample to sample; beyond the last
  /// one w stays as it is. `segment` is that of x, and then that of y.
  double next_after(double x, double a, std::size_t& segment) const {
    const double own = value(x, segment);
    double low = x, below = -2.0 * a * own;
    for (; segment + 1 < at_.size(); ++segment) {
      const double high = at_[segment + 1], above = high - x - a * (own + values_[segment + 1]);
      if (above >= 0.0) return low + (high - low) * below / (below - above);
      low = high;
      below = above;
    }
    return x + a * (own + values_.back());
  }
  /// The integral of 1 / (2 w): how many pieces there are at a spacing of 1.
  double pieces() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < at_.size(); ++i) sum += (at_[i] - at_[i - 1]) / (values_[i - 1] + values_[i]);
    return sum;
  }

 private:
  double value(double x, std::size_t segment) const {
    if (segment + 1 >= at_.size()) return values_.back();
    const double t = std::clamp((x - at_[segment]) / (at_[segment + 1] - at_[segment]), 0.0, 1.0);
    return (1.0 - t) * values_[segment] + t * values_[segment + 1];
  }
  const std::vector<double>& at_;
  std::vector<double> values_;
};

std::vector<double> marched(double begin, double a, int pieces, const Weight& w) {
  std::vector<double> x{begin};
  std::size_t segment = 0;
  for (int i = 0; i < pieces; ++i) x.push_back(w.next_after(x.back(), a, segment));
  return x;
}

}  // namespace

std::vector<double> section_abscissas(const std::vector<double>& abscissas, const std::vector<double>& radii,
                                      const std::vector<double>& curvatures, double spacing, double bending,
                                      int least) {
  const double begin = abscissas.front(), end = abscissas.back();
  const Weight w(abscissas, radii, curvatures, bending);
  const int pieces = std::max(least, static_cast<int>(std::lround(w.pieces() / spacing)));
  // With the spacing itself as the last unknown, the last section lies further on the larger it is.
  double low = 0.0, high = 2.0 * w.pieces() / pieces;
  while (marched(begin, high, pieces, w).back() < end) high *= 2.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (marched(begin, middle, pieces, w).back() < end ? low : high) = middle;
  }
  std::vector<double> x = marched(begin, high, pieces, w);
  x.back() = end;
  return x;
}

std::int32_t trunk_of(const geometry::Vec3& arriving, double radius,
                      const std::vector<geometry::Vec3>& directions, const std::vector<double>& radii,
                      double lambda) {
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double angle = std::acos(std::clamp(arriving.dot(directions[i]), -1.0, 1.0));
    const double disparity =
        lambda * angle / std::numbers::pi + (1.0 - lambda) * std::abs(radii[i] - radius) / radius;
    if (disparity >= least) continue;
    least = disparity;
    best = static_cast<std::int32_t>(i);
  }
  return best;
}

}  // namespace ostia::reconstruction
