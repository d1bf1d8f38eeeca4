#include "quality.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/sampling.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::registration {
namespace {

constexpr std::size_t points_at_once = 1024;

double median_on(const imaging::ImageVolume& scan, const std::vector<Vec3>& points) {
  std::vector<double> values;
  for (const Vec3& point : points)
    if (scan.geometry.contains(point)) values.push_back(imaging::sample(scan, point));
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string with_number(const char* form, double value) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), form, value);
  return text.data();
}

/// Why the result is of no use; empty when it may be.
std::string failure_of(const Quality& q, bool contrast) {
  if (!(q.jacobian_min > 0.0)) return "the transformation folds";
  if (q.overlap < 0.5)
    return with_number("the moving scan shows %.0f %% of the region only", 100.0 * q.overlap);
  if (q.landmarks_mean_mm > 6.0)
    return with_number("the trees are %.1f mm apart in the mean: the scans may be of two patients",
                       q.landmarks_mean_mm);
  if (contrast && q.vessels_fixed_hu < 130.0)
    return with_number("the vessels of the fixed scan have %.0f HU: it is without contrast",
                       q.vessels_fixed_hu);
  if (contrast && q.vessels_moving_hu < 130.0)
    return with_number(
        "where the vessels should be, the moving scan has %.0f HU: it is without contrast, or of another "
        "patient",
        q.vessels_moving_hu);
  if (q.correlation < 0.5)
    return with_number("the images do not fit onto each other (correlation %.2f)", q.correlation);
  return {};
}

/// Why a person should look.
std::string doubt_of(const Quality& q) {
  if (q.overlap < 0.9)
    return with_number("the moving scan shows %.0f %% of the region only", 100.0 * q.overlap);
  if (q.landmarks_mean_mm > 2.5)
    return with_number("the landmarks are %.1f mm apart in the mean", q.landmarks_mean_mm);
  if (q.landmarks_max_mm > 8.0) return with_number("a landmark is off by %.1f mm", q.landmarks_max_mm);
  if (q.correlation < 0.75) return with_number("the images fit loosely (correlation %.2f)", q.correlation);
  if (q.jacobian_min < 0.3 || q.jacobian_max > 3.0)
    return with_number("the heart is squeezed or stretched threefold at a place (least Jacobian %.2f)",
                       q.jacobian_min);
  if (q.inverse_consistency_mm > 1.5)
    return with_number("there and back again, a point is off by %.1f mm in the mean",
                       q.inverse_consistency_mm);
  return {};
}

}  // namespace

JacobianRange jacobian_range(const SplineGrid& spline, const std::vector<Vec3>& points) {
  const Transform bent(Mat3::Identity(), Vec3::Zero(), spline);
  const auto wider = [](const JacobianRange& a, const JacobianRange& b) {
    return JacobianRange{std::min(a.min, b.min), std::max(a.max, b.max)};
  };
  return core::parallel_reduce(
      points.size(), points_at_once, JacobianRange{},
      [&](std::size_t first, std::size_t last) {
        JacobianRange range;
        for (std::size_t i = first; i < last; ++i) {
          const double there = bent.jacobian(points[i]).determinant();
          range = wider(range, {there, there});
        }
        return range;
      },
      wider);
}

double inconsistency_mm(const SplineGrid& there, const SplineGrid& back, const std::vector<Vec3>& points) {
  const Transform go(Mat3::Identity(), Vec3::Zero(), there), come(Mat3::Identity(), Vec3::Zero(), back);
  const double sum = core::parallel_reduce(
      points.size(), points_at_once, 0.0,
      [&](std::size_t first, std::size_t last) {
        double part = 0.0;
        for (std::size_t i = first; i < last; ++i) part += (come(go(points[i])) - points[i]).norm();
        return part;
      },
      [](double a, double b) { return a + b; });
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

double correlation_of(const imaging::FloatVolume& fixed, const imaging::FloatVolume& moving,
                      const SplineGrid* spline, const std::vector<Vec3>& points) {
  const Transform bent = spline ? Transform(Mat3::Identity(), Vec3::Zero(), *spline) : Transform();
  using Sums = Eigen::Matrix<double, 6, 1>;
  const Sums s = core::parallel_reduce(
      points.size(), points_at_once, Sums(Sums::Zero()),
      [&](std::size_t first, std::size_t last) {
        Sums part = Sums::Zero();
        for (std::size_t i = first; i < last; ++i) {
          const Vec3 there = bent(points[i]);
          if (!moving.geometry.contains(there)) continue;
          const double a = imaging::sample(fixed, points[i]), b = imaging::sample(moving, there);
          part += (Sums() << 1.0, a, b, a * a, b * b, a * b).finished();
        }
        return part;
      },
      [](const Sums& a, const Sums& b) { return Sums(a + b); });
  if (s[0] < 2.0) return 0.0;
  const double aa = s[3] - s[1] * s[1] / s[0], bb = s[4] - s[2] * s[2] / s[0], ab = s[5] - s[1] * s[2] / s[0];
  return aa > 1e-12 && bb > 1e-12 ? ab / std::sqrt(aa * bb) : 0.0;
}

void judge(Quality& quality, const imaging::ImageVolume& fixed, const imaging::ImageVolume& moving,
           const Guidance& guidance, const Transform& transform, bool hounsfield) {
  for (const LandmarkPair& pair : guidance.landmarks) {
    const double left = (transform(pair.fixed_mm) - pair.moving_mm).norm();
    quality.landmarks_mean_mm += left / static_cast<double>(guidance.landmarks.size());
    quality.landmarks_max_mm = std::max(quality.landmarks_max_mm, left);
  }
  std::vector<Vec3> taken;
  for (const Vec3& point : guidance.vessels_mm) taken.push_back(transform(point));
  quality.vessels_fixed_hu = median_on(fixed, guidance.vessels_mm);
  quality.vessels_moving_hu = median_on(moving, taken);
  quality.reason = failure_of(quality, hounsfield && !taken.empty());
  quality.verdict = Verdict::failed;
  if (!quality.reason.empty()) return;
  quality.reason = doubt_of(quality);
  quality.verdict = quality.reason.empty() ? Verdict::good : Verdict::doubtful;
}

}  // namespace ostia::registration
