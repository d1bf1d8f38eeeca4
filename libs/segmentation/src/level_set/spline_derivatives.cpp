#include "level_set/spline_derivatives.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

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

/// Per voxel.
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
    sum.value += z.weight[k] * v00;
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

Derivatives derivatives_mm(const imaging::ImageVolume& image, const Vec3& index, std::int16_t brightest) {
  Derivatives d = derivatives_at(image, index, brightest);
  const Vec3& h = image.geometry.spacing;
  d.first = d.first.cwiseQuotient(h);
  d.pure = d.pure.cwiseQuotient(h.cwiseProduct(h));
  d.mixed = d.mixed.cwiseQuotient(Vec3(h[1] * h[2], h[0] * h[2], h[0] * h[1]));
  return d;
}

}  // namespace ostia::segmentation::detail
