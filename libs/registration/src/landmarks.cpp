#include "ostia/registration/landmarks.h"

#include "ostia/core/error.h"
#include "ostia/geometry/rigid_fit.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace ostia::registration {
namespace {

/// The used pairs' points of one scan, and of the other.
struct UsedPoints {
  std::vector<Vec3> fixed, moving;
  UsedPoints(const std::vector<LandmarkPair>& pairs, const std::vector<bool>& used) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (used[i]) {
        fixed.push_back(pairs[i].fixed_mm);
        moving.push_back(pairs[i].moving_mm);
      }
  }
};

bool on_a_line(const std::vector<Vec3>& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) spread += (point - middle) * (point - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solved(spread, Eigen::EigenvaluesOnly);
  return solved.eigenvalues()[1] <= 1e-6 * solved.eigenvalues()[2];
}

double root_mean_square(const std::vector<Vec3>& fixed, const std::vector<Vec3>& moving) {
  const geometry::RigidFit fit = geometry::rigid_fit(fixed, moving);
  double sum = 0.0;
  for (std::size_t i = 0; i < fixed.size(); ++i) sum += (fit(fixed[i]) - moving[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(fixed.size()));
}

/// Landmarks of one heart fit to some mm; those of its mirror image do so once they are reflected.
bool mirrored(const UsedPoints& points, double outlier_mm) {
  if (points.fixed.size() < 4) return false;
  const double as_is = root_mean_square(points.fixed, points.moving);
  std::vector<Vec3> reflected = points.fixed;
  for (Vec3& point : reflected) point.x() = -point.x();
  return as_is > outlier_mm && root_mean_square(reflected, points.moving) < 0.25 * as_is;
}

}  // namespace

void validate(const LandmarkOptions& options) {
  if (!(options.outlier_mm > 0.0))
    throw InvalidInput("landmarks: outlier_mm must be above 0, not " + std::to_string(options.outlier_mm));
  if (!(options.least_share > 0.0 && options.least_share <= 1.0))
    throw InvalidInput("landmarks: least_share must be above 0 and at most 1, not " +
                       std::to_string(options.least_share));
}

LandmarkFit rigid_from_landmarks(const std::vector<LandmarkPair>& pairs, const LandmarkOptions& options) {
  validate(options);
  if (pairs.size() < 3)
    throw InvalidInput("a rigid map needs three pairs of landmarks, there are " +
                       std::to_string(pairs.size()));
  for (const LandmarkPair& pair : pairs)
    if (!pair.fixed_mm.allFinite() || !pair.moving_mm.allFinite())
      throw InvalidInput("the landmark \"" + pair.name + "\" has a coordinate that is not a finite number");
  LandmarkFit result;
  result.used.assign(pairs.size(), true);
  const auto least = std::max<std::size_t>(
      3, static_cast<std::size_t>(std::ceil(options.least_share * static_cast<double>(pairs.size()))));
  const UsedPoints all(pairs, result.used);
  if (on_a_line(all.fixed) || on_a_line(all.moving))
    throw InvalidInput(
        "the landmarks lie on a line: they say nothing of a turn about it; give one beside it");
  if (mirrored(all, options.outlier_mm))
    throw InvalidInput(
        "the landmarks fit only as a mirror image: left and right are exchanged in one of the scans; look at "
        "its orientation");
  geometry::RigidFit fit = geometry::rigid_fit(all.fixed, all.moving);
  for (std::size_t left = pairs.size();; --left) {
    result.residuals_mm.clear();
    std::size_t worst = 0;
    double sum = 0.0;
    result.max_mm = -1.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      result.residuals_mm.push_back((fit(pairs[i].fixed_mm) - pairs[i].moving_mm).norm());
      if (!result.used[i]) continue;
      sum += result.residuals_mm[i];
      if (result.residuals_mm[i] > result.max_mm) {
        result.max_mm = result.residuals_mm[i];
        worst = i;
      }
    }
    result.mean_mm = sum / static_cast<double>(left);
    if (result.max_mm <= options.outlier_mm || left <= least) break;
    result.used[worst] = false;
    const UsedPoints kept(pairs, result.used);
    fit = geometry::rigid_fit(kept.fixed, kept.moving);
  }
  result.transform = Transform(fit.rotation, fit.shift);
  return result;
}

}  // namespace ostia::registration
