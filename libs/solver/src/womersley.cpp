#include "ostia/solver/womersley.h"

#include "ostia/core/error.h"

#include <cmath>
#include <numbers>

namespace ostia::solver {
namespace {

using Complex = std::complex<double>;

constexpr double series_up_to = 25.0;  // its cancellation costs exp(0.3 x): four digits there
constexpr double parabola_below = 1e-3;

const Complex turn = std::polar(1.0, 0.75 * std::numbers::pi);  // i^(3/2)

/// sum (-1)^k (z/2)^(2k + n) / (k! (k + n)!)  (Abramowitz and Stegun 9.1.10)
Complex by_series(int order, double x) {
  const Complex z = turn * x, quarter = -z * z / 4.0;
  Complex term = order == 0 ? Complex(1.0) : z / 2.0, sum = term;
  for (int k = 1; k < 200; ++k) {
    term *= quarter / static_cast<double>(k * (k + order));
    sum += term;
    if (std::abs(term) < 1e-18 * std::abs(sum)) break;
  }
  return sum * std::exp(-x / std::numbers::sqrt2);
}

/// Half of Hankel's second function (9.2.8), the larger one by exp(sqrt(2) x).
Complex by_asymptotics(int order, double x) {
  const Complex z = turn * x;
  Complex term = 1.0, sum = 1.0;
  for (int k = 1; k <= 20; ++k) {
    const double odd = 2.0 * k - 1.0;
    const Complex next = term * Complex(0.0, -1.0) * (4.0 * order * order - odd * odd) / (8.0 * k * z);
    if (std::abs(next) >= std::abs(term)) break;
    term = next;
    sum += term;
  }
  const double phase = order * std::numbers::pi / 2.0 + std::numbers::pi / 4.0;
  // exp(-i z) = exp(x / sqrt(2)) exp(i x / sqrt(2)): the first factor is what is taken out.
  return std::sqrt(1.0 / (2.0 * std::numbers::pi * z)) * std::polar(1.0, x / std::numbers::sqrt2 + phase) *
         sum;
}

}  // namespace

double womersley_number(double radius_mm, double angular_frequency, double viscosity_mm2_s) {
  return radius_mm * std::sqrt(angular_frequency / viscosity_mm2_s);
}

Complex scaled_bessel(int order, double x) {
  return x <= series_up_to ? by_series(order, x) : by_asymptotics(order, x);
}

Complex womersley_profile(double alpha, double radius) {
  if (!(alpha >= 0.0) || !(radius >= 0.0 && radius <= 1.0))
    throw InvalidInput("Womersley's profile needs alpha >= 0 and a radius in [0, 1]");
  if (alpha < parabola_below) return 2.0 * (1.0 - radius * radius);  // the next term is of order alpha^2
  const Complex wall = scaled_bessel(0, alpha);
  const double decay = std::exp(-alpha * (1.0 - radius) / std::numbers::sqrt2);
  const Complex here = scaled_bessel(0, alpha * radius) * decay / wall;
  const Complex mean = 1.0 - 2.0 * scaled_bessel(1, alpha) / (turn * alpha * wall);
  return (1.0 - here) / mean;
}

}  // namespace ostia::solver
