#include "level_set/feature_force.h"

#include "level_set/spline_derivatives.h"

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

}  // namespace

Sample GridFeatureForce::at(const Vec3& index, const Vec3& normal) const {
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

EdgeFeatureForce::EdgeFeatureForce(const imaging::ImageVolume& image, const imaging::Geometry& grid,
                                   const EdgeFeature& edge)
    : image_(image),
      first_(image.geometry.index(grid.origin)),
      edge_(edge),
      brightest_(static_cast<std::int16_t>(std::clamp(edge.brightest_hu, -32768.0, 32767.0))) {
  for (int d = 0; d < 3; ++d) first_[d] = std::round(first_[d]);
}

Sample EdgeFeatureForce::upwind_at(const Vec3& index, const Vec3& normal) const {
  const Vec3& spacing = image_.geometry.spacing;
  const double h = spacing.minCoeff();
  const Vec3 size = normal.cwiseAbs();
  const double lag = 0.5 * h * size.cwiseProduct(size).dot(size);  // as in GridFeatureForce
  const Vec3 at = index - (lag * normal).cwiseQuotient(spacing);
  const Derivatives here = derivatives_mm(image_, at, brightest_);
  Sample sum;
  for (int d = 0; d < 3; ++d) {
    Derivatives darker = here;
    for (const double way : {-1.0, 1.0}) {
      const Derivatives there = derivatives_mm(image_, at + way * h / spacing[d] * Vec3::Unit(d), brightest_);
      if (there.value < darker.value) darker = there;
    }
    const double difference = (here.value - darker.value) / h;
    sum.value += difference * difference;
    sum.gradient += difference / h * (here.first - darker.first);
  }
  return sum;
}

Sample EdgeFeatureForce::at(const Vec3& index, const Vec3& normal) const {
  const Vec3 place = index + first_;
  const Derivatives d = derivatives_mm(image_, place, brightest_);
  Sample p{d.first.squaredNorm(), Vec3::Zero()};
  if (edge_.upwind) {
    p = upwind_at(place, normal);
  } else {
    p.gradient = d.times(d.first);
  }
  if (edge_.curvature_correction) p.gradient += curvature_correction(d, edge_.blur) * d.first;
  const double k2 = edge_.noise_hu_per_mm * edge_.noise_hu_per_mm;
  return {0.5 * std::log1p(p.value / k2), p.gradient / (k2 + p.value)};
}

double curvature_correction(const Derivatives& d, const Vec3& blur) {
  const double squared = d.first.squaredNorm();
  if (squared <= 1e-12) return 0.0;
  const Vec3 n = d.first / std::sqrt(squared);
  const Vec3 blurred = blur.cwiseProduct(n);
  const double across = n.dot(blurred);
  const Vec3 bend = d.times(n);
  // The trace of blur and second derivatives on the wall's tangent plane, and what blur couples to it.
  const double trace = blur.dot(d.pure) - 2.0 * bend.dot(blurred) + across * n.dot(bend);
  const Vec3 coupled = blurred - across * n;
  const double corrected = trace - 3.0 * coupled.dot(d.times(coupled)) / across;
  // Where the coupling outweighs all else the blur is as wide as the vessel, and the first order in the
  // wall's curvature, which this is, has no say.
  return corrected * trace > 0.0 ? 0.5 * corrected / across : 0.0;
}

}  // namespace ostia::segmentation::detail
