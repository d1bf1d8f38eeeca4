#include "ostia/motion/cyclic_spline.h"

#include "ostia/core/error.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::motion {
namespace {

using geometry::Vec3;

void validate(const std::vector<double>& phases, const std::vector<std::vector<Vec3>>& places) {
  if (phases.size() < 3)
    throw InvalidInput("a cycle cannot be interpolated between " + std::to_string(phases.size()) +
                       " phases: give three at least");
  if (places.size() != phases.size()) throw InvalidInput("a cycle needs places for each of its phases");
  for (std::size_t k = 0; k < phases.size(); ++k) {
    if (!(phases[k] >= 0.0 && phases[k] < 1.0) || (k > 0 && phases[k] <= phases[k - 1]))
      throw InvalidInput("phases must rise, from 0 to below 1; number " + std::to_string(k + 1) + " is " +
                         std::to_string(phases[k]));
    if (places[k].size() != places[0].size() || places[k].empty())
      throw InvalidInput("the phase " + std::to_string(phases[k]) + " has " +
                         std::to_string(places[k].size()) + " points, the first has " +
                         std::to_string(places[0].size()));
  }
}

/// Second derivatives at the knots of a C2 spline, as a matrix on the values there: the usual equations of
/// cubic splines, closed to a ring.
Eigen::MatrixXd second_derivatives(const std::vector<double>& phases) {
  const auto n = static_cast<Eigen::Index>(phases.size());
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n, n), right = left;
  const auto width = [&](Eigen::Index k) {
    const auto i = static_cast<std::size_t>(k);
    return k + 1 < n ? phases[i + 1] - phases[i] : 1.0 + phases[0] - phases[i];
  };
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index before = (k + n - 1) % n, after = (k + 1) % n;
    const double a = width(before), b = width(k);
    left(k, before) += a / 6.0;
    left(k, k) += (a + b) / 3.0;
    left(k, after) += b / 6.0;
    right(k, before) += 1.0 / a;
    right(k, k) -= 1.0 / a + 1.0 / b;
    right(k, after) += 1.0 / b;
  }
  return left.partialPivLu().solve(right);
}

}  // namespace

CyclicSpline::CyclicSpline(std::vector<double> phases, std::vector<std::vector<Vec3>> places)
    : phases_(std::move(phases)), places_(std::move(places)) {
  validate(phases_, places_);
  const Eigen::MatrixXd matrix = second_derivatives(phases_);
  second_.assign(phases_.size(), std::vector<Vec3>(points(), Vec3::Zero()));
  for (std::size_t k = 0; k < phases_.size(); ++k)
    for (std::size_t m = 0; m < phases_.size(); ++m) {
      const double weight = matrix(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(m));
      for (std::size_t i = 0; i < points(); ++i) second_[k][i] += weight * places_[m][i];
    }
}

CyclicSpline::Piece CyclicSpline::piece(double phase) const {
  if (!std::isfinite(phase)) throw InvalidInput("a phase must be a number");
  phase -= std::floor(phase);
  const std::size_t n = phases_.size();
  const auto after =
      static_cast<std::size_t>(std::upper_bound(phases_.begin(), phases_.end(), phase) - phases_.begin());
  Piece piece{};
  piece.to = after % n;
  piece.from = (after + n - 1) % n;
  const double from = after == 0 ? phases_.back() - 1.0 : phases_[after - 1];
  const double to = after == n ? phases_.front() + 1.0 : phases_[after];
  piece.width = to - from;
  piece.share = (phase - from) / piece.width;
  return piece;
}

std::vector<Vec3> CyclicSpline::at(double phase) const {
  const Piece p = piece(phase);
  const double b = p.share, a = 1.0 - b, square = p.width * p.width / 6.0;
  const double a2 = (a * a * a - a) * square, b2 = (b * b * b - b) * square;
  std::vector<Vec3> result(points());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] =
        a * places_[p.from][i] + b * places_[p.to][i] + a2 * second_[p.from][i] + b2 * second_[p.to][i];
  return result;
}

std::vector<Vec3> CyclicSpline::rate(double phase) const {
  const Piece p = piece(phase);
  const double b = p.share, a = 1.0 - b;
  const double a2 = (1.0 - 3.0 * a * a) * p.width / 6.0, b2 = (3.0 * b * b - 1.0) * p.width / 6.0;
  std::vector<Vec3> result(points());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] =
        (places_[p.to][i] - places_[p.from][i]) / p.width + a2 * second_[p.from][i] + b2 * second_[p.to][i];
  return result;
}

}  // namespace ostia::motion
