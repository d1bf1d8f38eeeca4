#include "pull.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

/// Weights of the quadratic B-spline on the three voxels about x, and their slopes.
struct QuadraticTaps {
  std::int64_t first = 0;
  std::array<double, 3> weight{};
  std::array<double, 3> slope{};
};

QuadraticTaps quadratic_taps(double x, std::int64_t size) {
  QuadraticTaps taps;
  const double clamped = std::clamp(x, 1.0, static_cast<double>(size - 2));
  const auto middle = static_cast<std::int64_t>(clamped + 0.5);
  const double t = clamped - static_cast<double>(middle);  // in [-0.5, 0.5)
  taps.first = middle - 1;
  taps.weight = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  taps.slope = {t - 0.5, -2.0 * t, t + 0.5};
  return taps;
}

/// Weights of the cubic B-spline on the four voxels about x, with first and second derivatives. Voxels beyond
/// the border are those of the border.
struct CubicTaps {
  std::array<std::int64_t, 4> voxel{};
  std::array<double, 4> weight{};
  std::array<double, 4> slope{};
  std::array<double, 4> bend{};
};

CubicTaps cubic_taps(double x, std::int64_t size) {
  CubicTaps taps;
  const double clamped = std::clamp(x, 0.0, static_cast<double>(size - 1));
  const double base = std::floor(clamped);
  const double t = clamped - base;
  const double u = 1.0 - t;
  for (int n = 0; n < 4; ++n) {
    taps.voxel[n] = std::clamp<std::int64_t>(static_cast<std::int64_t>(base) - 1 + n, 0, size - 1);
  }
  taps.weight = {u * u * u / 6.0, 2.0 / 3.0 - 0.5 * t * t * (2.0 - t), 2.0 / 3.0 - 0.5 * u * u * (2.0 - u),
                 t * t * t / 6.0};
  taps.slope = {-0.5 * u * u, 0.5 * t * (3.0 * t - 4.0), -0.5 * u * (3.0 * u - 4.0), 0.5 * t * t};
  taps.bend = {u, 3.0 * t - 2.0, 3.0 * u - 2.0, t};
  return taps;
}

/// First and second derivatives of the cubic B-spline, per voxel: x, y, z; xx, yy, zz, yz, xz, xy.
struct Derivatives {
  Vec3 first = Vec3::Zero();
  Vec3 pure = Vec3::Zero();
  Vec3 mixed = Vec3::Zero();
};

Derivatives derivatives_at(const imaging::ImageVolume& image, const Vec3& index, std::int16_t brightest) {
  const auto& size = image.geometry.size;
  const CubicTaps x = cubic_taps(index[0], size[0]);
  const CubicTaps y = cubic_taps(index[1], size[1]);
  const CubicTaps z = cubic_taps(index[2], size[2]);
  Derivatives sum;
  for (int k = 0; k < 4; ++k) {
    double v00 = 0.0, v10 = 0.0, v20 = 0.0, v01 = 0.0, v11 = 0.0, v02 = 0.0;  // orders of d/dx and d/dy
    for (int j = 0; j < 4; ++j) {
      const std::int16_t* row = image.voxels.data() + image.geometry.offset(0, y.voxel[j], z.voxel[k]);
      double r0 = 0.0, r1 = 0.0, r2 = 0.0;
      for (int i = 0; i < 4; ++i) {
        const double value = std::min(row[x.voxel[i]], brightest);
        r0 += x.weight[i] * value;
        r1 += x.slope[i] * value;
        r2 += x.bend[i] * value;
      }
      v00 += y.weight[j] * r0;
      v10 += y.weight[j] * r1;
      v20 += y.weight[j] * r2;
      v01 += y.slope[j] * r0;
      v11 += y.slope[j] * r1;
      v02 += y.bend[j] * r0;
    }
    sum.first[0] += z.weight[k] * v10;
    sum.first[1] += z.weight[k] * v01;
    sum.first[2] += z.slope[k] * v00;
    sum.pure[0] += z.weight[k] * v20;
    sum.pure[1] += z.weight[k] * v02;
    sum.pure[2] += z.bend[k] * v00;
    sum.mixed[0] += z.slope[k] * v01;
    sum.mixed[1] += z.slope[k] * v10;
    sum.mixed[2] += z.weight[k] * v11;
  }
  return sum;
}

}  // namespace

Sample GridPull::at(const Vec3& index, const Vec3& normal) const {
  const imaging::Geometry& g = feature_.geometry;
  // A one-sided difference along axis d belongs half a voxel off, |n_d| h_d / 2 along the normal, and counts
  // with n_d^2.
  const Vec3 size = normal.cwiseAbs();
  const double lag = offset_ * size.cwiseProduct(size).cwiseProduct(size).dot(g.spacing);
  const Vec3 at = index - (lag * normal).cwiseQuotient(g.spacing);
  const QuadraticTaps x = quadratic_taps(at[0], g.size[0]);
  const QuadraticTaps y = quadratic_taps(at[1], g.size[1]);
  const QuadraticTaps z = quadratic_taps(at[2], g.size[2]);
  Sample sum;
  for (int k = 0; k < 3; ++k) {
    Sample plane;
    for (int j = 0; j < 3; ++j) {
      const float* p = feature_.voxels.data() + g.offset(x.first, y.first + j, z.first + k);
      const double row = x.weight[0] * p[0] + x.weight[1] * p[1] + x.weight[2] * p[2];
      const double row_slope = x.slope[0] * p[0] + x.slope[1] * p[1] + x.slope[2] * p[2];
      plane.value += y.weight[j] * row;
      plane.gradient[0] += y.weight[j] * row_slope;
      plane.gradient[1] += y.slope[j] * row;
    }
    sum.value += z.weight[k] * plane.value;
    sum.gradient[0] += z.weight[k] * plane.gradient[0];
    sum.gradient[1] += z.weight[k] * plane.gradient[1];
    sum.gradient[2] += z.slope[k] * plane.value;
  }
  sum.gradient = sum.gradient.cwiseQuotient(g.spacing);
  return sum;
}

EdgePull::EdgePull(const imaging::ImageVolume& image, const imaging::Geometry& grid, const EdgeFeature& edge)
    : image_(image),
      first_(image.geometry.index(grid.origin)),
      edge_(edge),
      brightest_(static_cast<std::int16_t>(std::clamp(edge.brightest_hu, -32768.0, 32767.0))) {
  for (int d = 0; d < 3; ++d) first_[d] = std::round(first_[d]);
}

Sample EdgePull::at(const Vec3& index, const Vec3& /*normal*/) const {
  const Derivatives d = derivatives_at(image_, index + first_, brightest_);
  const Vec3& h = image_.geometry.spacing;
  const Vec3 g = d.first.cwiseQuotient(h);
  const Vec3 pure = d.pure.cwiseQuotient(h.cwiseProduct(h));
  const Vec3 mixed(d.mixed[0] / (h[1] * h[2]), d.mixed[1] / (h[0] * h[2]), d.mixed[2] / (h[0] * h[1]));
  Vec3 turned(pure[0] * g[0] + mixed[2] * g[1] + mixed[1] * g[2],
              mixed[2] * g[0] + pure[1] * g[1] + mixed[0] * g[2],
              mixed[1] * g[0] + mixed[0] * g[1] + pure[2] * g[2]);
  const double squared = g.squaredNorm();
  const double k2 = edge_.noise_hu_per_mm * edge_.noise_hu_per_mm;
  if (edge_.curvature_correction && squared > 1e-12) {
    // Half of what tells the Laplacian from the second derivative along the gradient, along the gradient.
    const double along = g.dot(turned) / squared;
    turned += 0.5 * (pure.sum() - along) * g;
  }
  return {0.5 * std::log1p(squared / k2), turned / (k2 + squared)};
}

}  // namespace ostia::segmentation::detail
