#pragma once
/// \file A number with its derivative: forward differentiation of what is written once for both.

#include <cmath>

namespace ostia::hemodynamics {

struct Dual {
  double value = 0.0, slope = 0.0;
  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: numbers are duals without a slope
  Dual(double v, double s) : value(v), slope(s) {}
};

inline Dual operator+(Dual a, Dual b) {
  return {a.value + b.value, a.slope + b.slope};
}
inline Dual operator-(Dual a, Dual b) {
  return {a.value - b.value, a.slope - b.slope};
}
inline Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
inline Dual operator/(Dual a, Dual b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.slope - quotient * b.slope) / b.value};
}
inline Dual sqrt(Dual a) {
  const double root = std::sqrt(a.value);
  return {root, root > 0.0 ? 0.5 * a.slope / root : 0.0};
}
inline Dual exp(Dual a) {
  const double value = std::exp(a.value);
  return {value, value * a.slope};
}
inline Dual log(Dual a) {
  return {std::log(a.value), a.slope / a.value};
}
inline Dual pow(Dual a, double power) {
  const double value = std::pow(a.value, power);
  return {value, a.value > 0.0 ? power * value / a.value * a.slope : 0.0};
}
inline Dual tanh(Dual a) {
  const double value = std::tanh(a.value);
  return {value, (1.0 - value * value) * a.slope};
}
inline double value_of(double a) {
  return a;
}
inline double value_of(Dual a) {
  return a.value;
}

}  // namespace ostia::hemodynamics
