#include "ostia/phantom/radial_profile.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

/// Weights of the four neighbours at t in [0, 1] between the two in the middle (Catmull and Rom 1974).
std::array<double, 4> catmull_rom(double t) {
  const double u = 1.0 - t;
  return {-0.5 * t * u * u, 1.0 + t * t * (1.5 * t - 2.5), 1.0 + u * u * (1.5 * u - 2.5), -0.5 * u * t * t};
}

}  // namespace

RadialProfile::RadialProfile(double step_mm, int around, std::vector<double> radii)
    : step_mm_(step_mm), around_(around), radii_(std::move(radii)) {
  if (!(step_mm > 0.0) || !std::isfinite(step_mm))
    throw InvalidInput("radial profile: the step must be a positive number of mm, not " +
                       std::to_string(step_mm));
  if (around < 4 || radii_.size() % static_cast<std::size_t>(around) != 0 ||
      radii_.size() < 4 * static_cast<std::size_t>(around))
    throw InvalidInput("radial profile: " + std::to_string(radii_.size()) +
                       " radii do not fill four rows or more of " + std::to_string(around) +
                       " angles (four angles or more)");
  for (const double r : radii_) {
    if (!(r > 0.0) || !std::isfinite(r))
      throw InvalidInput("radial profile: a radius of " + std::to_string(r) + " mm; radii must be positive");
  }
  rows_ = static_cast<int>(radii_.size() / static_cast<std::size_t>(around));
  const auto [low, high] = std::minmax_element(radii_.begin(), radii_.end());
  // The four weights' absolute sum is at most 1.25 in each direction.
  const double middle = 0.5 * (*low + *high), half = 0.5 * 1.25 * 1.25 * (*high - *low);
  largest_ = middle + half;
  smallest_ = std::max(0.0, middle - half);
}

double RadialProfile::length_mm() const {
  return around_ == 0 ? 0.0 : step_mm_ * (rows_ - 1);
}

double RadialProfile::at(double s_mm, double theta) const {
  const double x = std::clamp(s_mm / step_mm_, 0.0, static_cast<double>(rows_ - 1));
  const int row = std::min(static_cast<int>(x), rows_ - 2);
  const auto along = catmull_rom(x - static_cast<double>(row));
  const double turn = theta * (0.5 / std::numbers::pi);
  const double y = (turn - std::floor(turn)) * around_;
  const int whole = static_cast<int>(y), column = whole >= around_ ? 0 : whole;
  const auto across = catmull_rom(y - whole);
  std::array<int, 4> columns;
  for (int c = 0; c < 4; ++c) {
    const int at = column + c - 1;
    columns[static_cast<std::size_t>(c)] = at < 0 ? at + around_ : at >= around_ ? at - around_ : at;
  }
  double sum = 0.0;
  for (int r = 0; r < 4; ++r) {
    const double* values = radii_.data() + std::clamp(row + r - 1, 0, rows_ - 1) * around_;
    double part = 0.0;
    for (std::size_t c = 0; c < 4; ++c) part += across[c] * values[columns[c]];
    sum += along[static_cast<std::size_t>(r)] * part;
  }
  return sum;
}

namespace {

template <class Add>
void around_at(const RadialProfile& profile, double s_mm, const Add& add) {
  const int n = 4 * profile.around();
  for (int i = 0; i < n; ++i) add(profile.at(s_mm, 2.0 * std::numbers::pi * i / n), n);
}

}  // namespace

double RadialProfile::mean_at(double s_mm) const {
  double sum = 0.0;
  around_at(*this, s_mm, [&](double r, int n) { sum += r / n; });
  return sum;
}

double RadialProfile::min_at(double s_mm) const {
  double least = largest_;
  around_at(*this, s_mm, [&](double r, int) { least = std::min(least, r); });
  return least;
}

double RadialProfile::max_at(double s_mm) const {
  double most = 0.0;
  around_at(*this, s_mm, [&](double r, int) { most = std::max(most, r); });
  return most;
}

// The integral of r^2 / 2 over the angle; the rectangle rule of a smooth periodic function.
double RadialProfile::area_at(double s_mm) const {
  double sum = 0.0;
  around_at(*this, s_mm, [&](double r, int n) { sum += r * r * std::numbers::pi / n; });
  return sum;
}

}  // namespace ostia::phantom
