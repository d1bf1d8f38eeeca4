#include "ostia/geometry/spline.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

using Eigen::Vector4d;

// One cubic piece over [0, h] by its end values and second derivatives.
struct SplinePiece {
  const Vector4d& p0;
  const Vector4d& p1;
  const Vector4d& m0;
  const Vector4d& m1;
  double h;

  Vector4d value(double u) const {
    const double b = u / h, a = 1.0 - b;
    return a * p0 + b * p1 + (h * h / 6.0) * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
  }
  Vector4d first(double u) const {
    const double b = u / h, a = 1.0 - b;
    return (p1 - p0) / h + (h / 6.0) * ((1.0 - 3.0 * a * a) * m0 + (3.0 * b * b - 1.0) * m1);
  }
  Vector4d second(double u) const {
    const double b = u / h;
    return (1.0 - b) * m0 + b * m1;
  }
  double speed(double u) const { return first(u).head<3>().norm(); }
};

double gauss(const SplinePiece& piece, double from, double to) {
  constexpr std::array<double, 3> node{0.238619186083196909, 0.661209386466264514, 0.932469514203152028};
  constexpr std::array<double, 3> weight{0.467913934572691047, 0.360761573048138608, 0.171324492379170345};
  const double centre = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    sum += weight[i] * (piece.speed(centre - half * node[i]) + piece.speed(centre + half * node[i]));
  }
  return half * sum;
}

// Halves until both halves agree with the whole; only a piece that nearly stops (a cusp) needs that.
double arc_length(const SplinePiece& piece, double from, double to, double whole, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss(piece, from, middle), right = gauss(piece, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-10 * piece.h) return left + right;
  return arc_length(piece, from, middle, left, depth - 1) + arc_length(piece, middle, to, right, depth - 1);
}

double arc_length(const SplinePiece& piece, double to) {
  return to > 0.0 ? arc_length(piece, 0.0, to, gauss(piece, 0.0, to), 16) : 0.0;
}

// Second derivatives of the natural cubic spline at its knots.
std::vector<Vector4d> natural_second(const std::vector<double>& knots, const std::vector<Vector4d>& values) {
  const std::size_t n = knots.size();
  std::vector<Vector4d> second(n, Vector4d::Zero());
  std::vector<double> pivot(n, 1.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = knots[i] - knots[i - 1], h1 = knots[i + 1] - knots[i];
    pivot[i] = 2.0 * (h0 + h1);
    second[i] = 6.0 * ((values[i + 1] - values[i]) / h1 - (values[i] - values[i - 1]) / h0);
    if (i > 1) {
      pivot[i] -= h0 * h0 / pivot[i - 1];
      second[i] -= (h0 / pivot[i - 1]) * second[i - 1];
    }
  }
  for (std::size_t i = n - 1; i-- > 1;) {
    if (i + 2 < n) second[i] -= (knots[i + 1] - knots[i]) * second[i + 1];
    second[i] /= pivot[i];
  }
  return second;
}

std::size_t interval(const std::vector<double>& knots, double t) {
  return static_cast<std::size_t>(std::upper_bound(knots.begin() + 1, knots.end() - 1, t) - knots.begin()) -
         1;
}

}  // namespace

ArcLengthSpline::ArcLengthSpline(const std::vector<Vec3>& points, const std::vector<double>& scalar) {
  if (!scalar.empty() && scalar.size() != points.size()) {
    throw InvalidInput("the spline got " + std::to_string(points.size()) + " points and " +
                       std::to_string(scalar.size()) + " scalars; give none or one a point");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    Vector4d value;
    value << points[i], scalar.empty() ? 0.0 : scalar[i];
    if (!value.allFinite()) throw InvalidInput("point " + std::to_string(i) + " of the spline is not finite");
    const double chord = values_.empty() ? 0.0 : (value - values_.back()).head<3>().norm();
    if (!values_.empty() && !(chord > 0.0)) continue;  // the same point again adds nothing
    knots_.push_back(values_.empty() ? 0.0 : knots_.back() + chord);
    values_.push_back(value);
  }
  if (values_.size() < 2) throw InvalidInput("a spline needs at least two distinct points");
  second_ = natural_second(knots_, values_);
  arc_.assign(1, 0.0);
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1],
                            knots_[i + 1] - knots_[i]};
    arc_.push_back(arc_.back() + arc_length(piece, piece.h));
  }
}

double ArcLengthSpline::length() const {
  return arc_.back();
}

double ArcLengthSpline::parameter(double abscissa_mm) const {
  const double s = std::clamp(abscissa_mm, 0.0, arc_.back());
  const std::size_t i = interval(arc_, s);
  const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1], knots_[i + 1] - knots_[i]};
  const double target = s - arc_[i], whole = arc_[i + 1] - arc_[i];
  if (target <= 0.0) return knots_[i];
  if (target >= whole) return knots_[i + 1];
  double low = 0.0, high = piece.h, u = piece.h * target / whole;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double error = arc_length(piece, u) - target;
    if (std::abs(error) <= 1e-9 * whole) break;
    (error > 0.0 ? high : low) = u;
    const double newton = u - error / piece.speed(u);
    u = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  return knots_[i] + u;
}

Vec3 ArcLengthSpline::point(double abscissa_mm) const {
  const double t = parameter(abscissa_mm);
  const std::size_t i = interval(knots_, t);
  const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1], knots_[i + 1] - knots_[i]};
  return piece.value(t - knots_[i]).head<3>();
}

double ArcLengthSpline::scalar(double abscissa_mm) const {
  const double t = parameter(abscissa_mm);
  const std::size_t i = interval(knots_, t);
  const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1], knots_[i + 1] - knots_[i]};
  return piece.value(t - knots_[i])[3];
}

Vec3 ArcLengthSpline::tangent(double abscissa_mm) const {
  const double t = parameter(abscissa_mm);
  const std::size_t i = interval(knots_, t);
  const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1], knots_[i + 1] - knots_[i]};
  const Vec3 derivative = piece.first(t - knots_[i]).head<3>();
  // The speed is about 1; where it vanishes (a cusp) the chord stands in.
  if (derivative.norm() > 1e-9) return derivative.normalized();
  return (values_[i + 1] - values_[i]).head<3>().normalized();
}

Vec3 ArcLengthSpline::curvature_vector(double abscissa_mm) const {
  const double t = parameter(abscissa_mm);
  const std::size_t i = interval(knots_, t);
  const SplinePiece piece{values_[i], values_[i + 1], second_[i], second_[i + 1], knots_[i + 1] - knots_[i]};
  const Vec3 derivative = piece.first(t - knots_[i]).head<3>();
  const Vec3 second = piece.second(t - knots_[i]).head<3>();
  const double squared = std::max(derivative.squaredNorm(), 1e-18);
  return (second - (second.dot(derivative) / squared) * derivative) / squared;
}

namespace {

void check(const std::vector<double>& t, std::size_t values, const std::vector<double>& weights,
           double lambda) {
  const std::size_t n = t.size();
  if (n < 2) throw InvalidInput("a smoothing spline needs at least two points, it got " + std::to_string(n));
  if (values != n || weights.size() != n) {
    throw InvalidInput("a smoothing spline got " + std::to_string(n) + " parameters, " +
                       std::to_string(values) + " values and " + std::to_string(weights.size()) +
                       " weights; give as many of each");
  }
  if (!(lambda >= 0.0) || !std::isfinite(lambda)) {
    throw InvalidInput("the smoothing spline's lambda is " + std::to_string(lambda) +
                       "; it must be 0 or more");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!(weights[i] > 0.0) || !std::isfinite(weights[i])) {
      throw InvalidInput("weight " + std::to_string(i) + " of the smoothing spline is " +
                         std::to_string(weights[i]) + "; it must be above 0");
    }
    if (!std::isfinite(t[i]) || (i > 0 && !(t[i] > t[i - 1]))) {
      throw InvalidInput("parameter " + std::to_string(i) + " of the smoothing spline is " +
                         std::to_string(t[i]) + "; parameters must increase strictly");
    }
  }
}

// With Q the second differences, R the integrals of hat functions and W the weights:
// (R + lambda Q' W^-1 Q) gamma = Q' y, fitted = y - lambda W^-1 Q gamma; the matrix has five diagonals.
template <class Value>
std::vector<Value> reinsch(const std::vector<double>& t, const std::vector<Value>& y,
                           const std::vector<double>& weights, double lambda, bool fix_ends) {
  check(t, y.size(), weights, lambda);
  const std::size_t n = t.size(), m = n - 2;
  if (m == 0 || lambda == 0.0) return y;
  std::vector<double> h(n - 1), slack(n);
  for (std::size_t i = 0; i + 1 < n; ++i) h[i] = t[i + 1] - t[i];
  for (std::size_t i = 0; i < n; ++i) slack[i] = lambda / weights[i];
  if (fix_ends) slack.front() = slack.back() = 0.0;

  // Column j of Q has q0, q1, q2 at rows j, j+1, j+2.
  const auto q0 = [&](std::size_t j) { return 1.0 / h[j]; };
  const auto q1 = [&](std::size_t j) { return -1.0 / h[j] - 1.0 / h[j + 1]; };
  const auto q2 = [&](std::size_t j) { return 1.0 / h[j + 1]; };
  std::vector<double> d(m), e(m, 0.0), f(m, 0.0);  // L D L': D, first and second subdiagonal of L (as D L')
  std::vector<Value> gamma(m);
  for (std::size_t j = 0; j < m; ++j) {
    d[j] = (h[j] + h[j + 1]) / 3.0 + slack[j] * q0(j) * q0(j) + slack[j + 1] * q1(j) * q1(j) +
           slack[j + 2] * q2(j) * q2(j);
    if (j + 1 < m)
      e[j] = h[j + 1] / 6.0 + slack[j + 1] * q1(j) * q0(j + 1) + slack[j + 2] * q2(j) * q1(j + 1);
    if (j + 2 < m) f[j] = slack[j + 2] * q2(j) * q0(j + 2);
    gamma[j] = (y[j + 2] - y[j + 1]) / h[j + 1] - (y[j + 1] - y[j]) / h[j];
  }
  for (std::size_t j = 0; j < m; ++j) {
    if (j + 1 < m) {
      const double factor = e[j] / d[j];
      d[j + 1] -= factor * e[j];
      if (j + 2 < m) e[j + 1] -= factor * f[j];
      gamma[j + 1] -= factor * gamma[j];
    }
    if (j + 2 < m) {
      const double factor = f[j] / d[j];
      d[j + 2] -= factor * f[j];
      gamma[j + 2] -= factor * gamma[j];
    }
  }
  for (std::size_t j = m; j-- > 0;) {
    if (j + 1 < m) gamma[j] -= e[j] * gamma[j + 1];
    if (j + 2 < m) gamma[j] -= f[j] * gamma[j + 2];
    gamma[j] /= d[j];
  }
  std::vector<Value> fitted = y;
  for (std::size_t j = 0; j < m; ++j) {
    fitted[j] -= slack[j] * q0(j) * gamma[j];
    fitted[j + 1] -= slack[j + 1] * q1(j) * gamma[j];
    fitted[j + 2] -= slack[j + 2] * q2(j) * gamma[j];
  }
  return fitted;
}

}  // namespace

std::vector<Vec3> smoothing_spline(const std::vector<double>& t, const std::vector<Vec3>& points,
                                   const std::vector<double>& weights, double lambda, bool fix_ends) {
  return reinsch(t, points, weights, lambda, fix_ends);
}

std::vector<double> smoothing_spline(const std::vector<double>& t, const std::vector<double>& values,
                                     const std::vector<double>& weights, double lambda, bool fix_ends) {
  return reinsch(t, values, weights, lambda, fix_ends);
}

}  // namespace ostia::geometry
