#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/evaluation/image_quality.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <string>

namespace ostia::evaluation {
namespace {

using Square = Eigen::MatrixXd;  // (i, j)
using Spectrum = Eigen::MatrixXcd;

/// The six polynomials of second order on a square, orthonormal, one a column.
Eigen::MatrixXd trends(int side) {
  Eigen::MatrixXd basis(side * side, 6);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = 2.0 * i / (side - 1) - 1.0, y = 2.0 * j / (side - 1) - 1.0;
      basis.row(i + side * j) << 1.0, x, y, x * x, x * y, y * y;
    }
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  return qr.householderQ() * Eigen::MatrixXd::Identity(side * side, 6);
}

Spectrum fourier_matrix(int side) {
  Spectrum f(side, side);
  for (int a = 0; a < side; ++a) {
    for (int b = 0; b < side; ++b)
      f(a, b) = std::polar(1.0, -2.0 * std::numbers::pi * ((a * b) % side) / side);
  }
  return f;
}

/// The parabola through the logarithms of all rings above two thirds of the highest, weighted by power. It
/// runs over f^(2/3): so drawn, the spectrum f exp(-f^2 / 2) is symmetric about its top to third order.
double peak_of(const std::vector<double>& frequency, const std::vector<double>& power) {
  const auto top = static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin());
  std::size_t first = top, last = top;
  while (first > 0 && power[first - 1] > 0.67 * power[top]) --first;
  while (last + 1 < power.size() && power[last + 1] > 0.67 * power[top]) ++last;
  if (last - first < 2) {
    first = top > 0 ? top - 1 : 0;
    last = std::min(top + 1, power.size() - 1);
  }
  if (last - first < 2 || power[first] <= 0.0 || power[last] <= 0.0) return frequency[top];
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t n = first; n <= last; ++n) {
    const double x = std::pow(frequency[n], 2.0 / 3.0) - std::pow(frequency[top], 2.0 / 3.0);
    const Eigen::Vector3d row(1.0, x, x * x);
    normal += power[n] * row * row.transpose();
    right += power[n] * std::log(power[n]) * row;
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  if (!(c[2] < 0.0)) return frequency[top];
  const double x = std::pow(frequency[top], 2.0 / 3.0) - 0.5 * c[1] / c[2];
  return std::clamp(std::pow(std::max(x, 0.0), 1.5), frequency[first], frequency[last]);
}

}  // namespace

namespace {

void require_regions(const imaging::ImageVolume& image, const std::vector<NoiseRegion>& regions, int side) {
  const imaging::Geometry& g = image.geometry;
  if (side < 8)
    throw InvalidInput("noise power: a side of " + std::to_string(side) + " voxels; at least 8 are needed");
  if (regions.empty()) throw InvalidInput("noise power: no region is given");
  for (const NoiseRegion& r : regions) {
    if (r[0] < 0 || r[1] < 0 || r[2] < 0 || r[0] + side > g.size[0] || r[1] + side > g.size[1] ||
        r[2] >= g.size[2])
      throw InvalidInput("noise power: the region at (" + std::to_string(r[0]) + ", " + std::to_string(r[1]) +
                         ", " + std::to_string(r[2]) + ") reaches beyond the image");
  }
}

/// The square of `side` voxels at (i, j, k) less its trend.
Eigen::VectorXd residual(const imaging::ImageVolume& image, const NoiseRegion& at, int side,
                         const Eigen::MatrixXd& trend) {
  Eigen::VectorXd values(side * side);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) values[i + side * j] = image(at[0] + i, at[1] + j, at[2]);
  }
  values -= trend * (trend.transpose() * values);
  return values;
}

}  // namespace

NoisePower noise_power(const imaging::ImageVolume& image, const std::vector<NoiseRegion>& regions, int side) {
  require_regions(image, regions, side);
  const imaging::Geometry& g = image.geometry;
  const Eigen::MatrixXd trend = trends(side);
  const Spectrum fourier = fourier_matrix(side);
  const Eigen::MatrixXd sum = core::parallel_reduce(
      regions.size(), 16, Eigen::MatrixXd(Eigen::MatrixXd::Zero(side, side)),
      [&](std::size_t first, std::size_t last) {
        Eigen::MatrixXd power = Eigen::MatrixXd::Zero(side, side);
        for (std::size_t n = first; n < last; ++n) {
          const Eigen::VectorXd values = residual(image, regions[n], side, trend);
          const Eigen::Map<const Square> square(values.data(), side, side);
          power += (fourier * square * fourier).cwiseAbs2();
        }
        return power;
      },
      [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return Eigen::MatrixXd(a + b); });
  // |F|^2 dx dy / n^2: its integral over frequencies is the variance.
  const double dx = g.spacing.x(), dy = g.spacing.y(), n2 = static_cast<double>(side) * side;
  const Eigen::MatrixXd power = sum * (dx * dy / n2 / static_cast<double>(regions.size()));
  NoisePower result;
  result.regions = regions.size();
  result.deviation_hu = std::sqrt(power.sum() / (n2 * dx * dy));
  const double ring = 1.0 / (side * std::max(dx, dy));
  const auto rings = static_cast<std::size_t>(std::floor(0.5 / std::max(dx, dy) / ring));
  std::vector<double> total(rings, 0.0), count(rings, 0.0), frequencies(rings, 0.0);
  std::complex<double> harmonic = 0.0;
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      const double fx = (u <= side / 2 ? u : u - side) / (side * dx),
                   fy = (v <= side / 2 ? v : v - side) / (side * dy);
      const double f = std::hypot(fx, fy);
      const auto r = static_cast<std::size_t>(std::floor(f / ring));
      if (r >= rings || (u == 0 && v == 0)) continue;
      total[r] += power(u, v);
      frequencies[r] += f;
      count[r] += 1.0;
      harmonic += power(u, v) * std::polar(1.0, 2.0 * std::atan2(fy, fx));
    }
  }
  double weighted = 0.0, whole = 0.0;
  for (std::size_t r = 0; r < rings; ++r) {
    if (count[r] == 0.0) continue;
    result.frequency_per_mm.push_back(frequencies[r] / count[r]);
    result.power_hu2_mm2.push_back(total[r] / count[r]);
    weighted += result.frequency_per_mm.back() * result.power_hu2_mm2.back();
    whole += result.power_hu2_mm2.back();
  }
  const double all = std::accumulate(total.begin(), total.end(), 0.0);
  if (all > 0.0) {
    result.anisotropy = std::abs(harmonic) / all;
    const double across = std::arg(harmonic) * 90.0 / std::numbers::pi;
    result.streaks_deg = std::fmod(across + 90.0 + 180.0, 180.0);
  }
  result.mean_per_mm = whole > 0.0 ? weighted / whole : 0.0;
  result.peak_per_mm = whole > 0.0 ? peak_of(result.frequency_per_mm, result.power_hu2_mm2) : 0.0;
  return result;
}

std::vector<double> noise_correlation_along_k(const imaging::ImageVolume& image,
                                              const std::vector<NoiseRegion>& regions, int side, int most) {
  require_regions(image, regions, side);
  if (most < 1) throw InvalidInput("noise correlation: at least one slice apart must be asked for");
  const Eigen::MatrixXd trend = trends(side);
  std::vector<double> result;
  for (int lag = 1; lag <= most; ++lag) {
    double product = 0.0, first = 0.0, second = 0.0;
    for (const NoiseRegion& at : regions) {
      if (at[2] + lag >= image.geometry.size[2]) continue;
      const Eigen::VectorXd a = residual(image, at, side, trend);
      const Eigen::VectorXd b = residual(image, {at[0], at[1], at[2] + lag}, side, trend);
      product += a.dot(b);
      first += a.squaredNorm();
      second += b.squaredNorm();
    }
    if (!(first > 0.0 && second > 0.0))
      throw InvalidInput("noise correlation: no square has noise in the slice " + std::to_string(lag) +
                         " above it, too");
    result.push_back(product / std::sqrt(first * second));
  }
  return result;
}

std::vector<NoiseRegion> noise_regions(const imaging::MaskVolume& mask, int side, int slice_step) {
  if (side < 1 || slice_step < 1) throw InvalidInput("noise regions: side and slice_step must be at least 1");
  const auto& size = mask.geometry.size;
  std::vector<NoiseRegion> result;
  for (std::int64_t k = 0; k < size[2]; k += slice_step) {
    for (std::int64_t j = 0; j + side <= size[1]; ++j) {
      bool any = false;
      for (std::int64_t i = 0; i + side <= size[0];) {
        bool inside = true;
        for (int dj = 0; dj < side && inside; ++dj) {
          for (int di = 0; di < side && inside; ++di) inside = mask(i + di, j + dj, k) != 0;
        }
        if (inside) result.push_back({i, j, k});
        any = any || inside;
        i += inside ? side : 1;
      }
      if (any) j += side - 1;
    }
  }
  return result;
}

}  // namespace ostia::evaluation
