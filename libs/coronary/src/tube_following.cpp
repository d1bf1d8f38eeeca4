#include "tube_following.h"

#include "ostia/geometry/frame.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace ostia::coronary {
namespace {

/// The line through the last stretch of the way, pointing ahead.
Vec3 ahead(const std::vector<DiscFit>& way, double hindsight_mm) {
  std::size_t first = way.size() - 1;
  double length = 0.0;
  while (first > 0 && length < hindsight_mm) {
    length += (way[first].centre - way[first - 1].centre).norm();
    --first;
  }
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = first; i < way.size(); ++i) mean += way[i].centre;
  mean /= static_cast<double>(way.size() - first);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = first; i < way.size(); ++i)
    spread += (way[i].centre - mean) * (way[i].centre - mean).transpose();
  const Vec3 line = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  return line.dot(way.back().centre - way[first].centre) < 0.0 ? Vec3(-line) : line;
}

SectionPlane across(const Vec3& centre, const Vec3& tangent) {
  const Vec3 u = geometry::initial_normal(tangent);
  return {centre, u, tangent.cross(u)};
}

bool comes_back(const std::vector<DiscFit>& way, const Vec3& to, double step_mm) {
  const auto recent = static_cast<std::size_t>(std::ceil(3.0 * way.back().radius_mm / step_mm));
  for (std::size_t i = 0; i + recent < way.size(); ++i)
    if ((way[i].centre - to).norm() < 0.5 * way[i].radius_mm) return true;
  return false;
}

}  // namespace

std::vector<TubeSection> follow_tube(const imaging::ImageVolume& image, const std::vector<DiscFit>& way,
                                     const FollowOptions& options, const core::TaskContext& task) {
  std::vector<DiscFit> all = way;
  std::vector<TubeSection> found;
  const auto most = static_cast<std::size_t>(options.longest_mm / options.step_mm);
  while (found.size() < most) {
    task.throw_if_cancelled();
    const Vec3 tangent = ahead(all, options.hindsight_mm);
    const Vec3 to = all.back().centre + options.step_mm * tangent;
    const std::optional<DiscFit> disc = fit_disc(image, across(to, tangent), options.disc);
    if (!disc || disc->round < options.least_round) break;
    // Measured against the last few, so that a wall that gives way slowly is seen.
    const DiscFit& before = all[all.size() - std::min<std::size_t>(all.size(), 3)];
    if (std::abs(disc->radius_mm / before.radius_mm - 1.0) > 2.0 * options.largest_change) break;
    if (std::abs(disc->radius_mm / all.back().radius_mm - 1.0) > options.largest_change) break;
    if ((disc->centre - to).norm() > options.largest_shift * options.step_mm + 0.05 * disc->radius_mm) break;
    if (comes_back(all, disc->centre, options.step_mm)) break;
    all.push_back(*disc);
    found.push_back({*disc, tangent});
  }
  return found;
}

}  // namespace ostia::coronary
