#pragma once
/// \file A number with its derivatives by one or two others: forward differentiation of what is written once
/// for both.

#include <cmath>

namespace ostia::hemodynamics {

/// Two slopes at once.
struct Slopes {
  double first = 0.0, second = 0.0;
};
inline Slopes operator+(Slopes a, Slopes b) {
  return {a.first + b.first, a.second + b.second};
}
inline Slopes operator-(Slopes a, Slopes b) {
  return {a.first - b.first, a.second - b.second};
}
inline Slopes operator*(Slopes a, double b) {
  return {a.first * b, a.second * b};
}

/// `Slope`: a number, or Slopes.
template <typename Slope>
struct DualBy {
  double value = 0.0;
  Slope slope{};
  DualBy() = default;
  DualBy(double v) : value(v) {}  // NOLINT: numbers are duals without a slope
  DualBy(double v, Slope s) : value(v), slope(s) {}

  friend DualBy operator+(DualBy a, DualBy b) { return {a.value + b.value, a.slope + b.slope}; }
  friend DualBy operator-(DualBy a, DualBy b) { return {a.value - b.value, a.slope - b.slope}; }
  friend DualBy operator*(DualBy a, DualBy b) {
    return {a.value * b.value, a.slope * b.value + b.slope * a.value};
  }
  friend DualBy operator/(DualBy a, DualBy b) {
    const double inverse = 1.0 / b.value, quotient = a.value * inverse;
    return {quotient, (a.slope - b.slope * quotient) * inverse};
  }
  friend DualBy sqrt(DualBy a) {
    const double root = std::sqrt(a.value);
    return {root, a.slope * (root > 0.0 ? 0.5 / root : 0.0)};
  }
  friend DualBy exp(DualBy a) {
    const double value = std::exp(a.value);
    return {value, a.slope * value};
  }
  friend DualBy log(DualBy a) { return {std::log(a.value), a.slope * (1.0 / a.value)}; }
  friend DualBy pow(DualBy a, double power) {
    const double value = std::pow(a.value, power);
    return {value, a.slope * (a.value > 0.0 ? power * value / a.value : 0.0)};
  }
  friend DualBy tanh(DualBy a) {
    const double value = std::tanh(a.value);
    return {value, a.slope * (1.0 - value * value)};
  }
  friend double value_of(DualBy a) { return a.value; }
};

inline double value_of(double a) {
  return a;
}

}  // namespace ostia::hemodynamics
