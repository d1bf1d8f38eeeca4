#include "change/axis_laying.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace ostia::analysis {
namespace {

using geometry::AxisFoot;
using geometry::Mat3;
using geometry::RigidFit;
using geometry::Vec3;
using MotionNormal = Eigen::Matrix<double, 6, 6>;
using MotionStep = Eigen::Matrix<double, 6, 1>;

constexpr int most_steps = 60;
constexpr double done_mm = 1e-5, least_cut_mm = 1.0, cut_medians = 3.0, damping = 1e-4;

/// A carried place and what it is away from its axis.
struct Miss {
  Vec3 place, away, tangent;
  Vec3 come;  ///< from where the start has carried it
  double distance_mm = 0.0;
};

std::vector<Miss> misses(const std::vector<PlacesOnAxis>& all, const RigidFit& motion,
                         const RigidFit& start) {
  std::vector<Miss> found;
  for (const PlacesOnAxis& one : all)
    for (const Vec3& place : one.places) {
      const Vec3 carried = motion(place);
      const AxisFoot foot = one.axis->nearest_foot(carried);
      if (foot.past_end) continue;
      const Vec3 away = carried - one.axis->point(foot.s_mm);
      found.push_back(
          {carried, away, one.axis->frame(foot.s_mm).tangent, carried - start(place), away.norm()});
    }
  return found;
}

double cut_of(const std::vector<Miss>& found) {
  std::vector<double> sorted;
  for (const Miss& one : found) sorted.push_back(one.distance_mm);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return std::max(least_cut_mm, cut_medians * *middle);
}

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// The motion after a step (a turn about the places' middle, and a shift).
RigidFit stepped(const std::vector<Miss>& found, const RigidFit& motion, double hold) {
  const double cut = cut_of(found);
  Vec3 middle = Vec3::Zero();
  for (const Miss& one : found) middle += one.place / static_cast<double>(found.size());
  MotionNormal normal = MotionNormal::Zero();
  MotionStep right = MotionStep::Zero();
  for (const Miss& one : found) {
    if (one.distance_mm > cut) continue;
    const Mat3 across = Mat3::Identity() - one.tangent * one.tangent.transpose();
    Eigen::Matrix<double, 3, 6> by;
    by.leftCols<3>() = -across * cross_matrix(one.place - middle);
    by.rightCols<3>() = across;
    normal += by.transpose() * by;
    right -= by.transpose() * (across * one.away);
    Eigen::Matrix<double, 1, 6> along;
    along.leftCols<3>() = -hold * one.tangent.transpose() * cross_matrix(one.place - middle);
    along.rightCols<3>() = hold * one.tangent.transpose();
    normal += along.transpose() * along;
    right -= along.transpose() * (hold * one.tangent.dot(one.come));
  }
  // What the axes leave open (a turn about a straight one, a shift along it) stays as it is.
  for (int i = 0; i < 6; ++i) normal(i, i) += damping * (normal(i, i) + 1.0);
  const MotionStep step = normal.ldlt().solve(right);
  const Vec3 turn = step.head<3>();
  const double angle = turn.norm();
  const Mat3 rotation =
      angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3(Mat3::Identity());
  RigidFit next;
  next.rotation = rotation * motion.rotation;
  next.shift = rotation * (motion.shift - middle) + middle + step.tail<3>();
  return next;
}

double mean_distance(const std::vector<Miss>& found) {
  if (found.empty()) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Miss& one : found) sum += one.distance_mm;
  return sum / static_cast<double>(found.size());
}

/// Few places that happen to have a foot are no better fit than many.
bool better(const LaidPlaces& one, const LaidPlaces& other) {
  return 5 * one.places >= 4 * other.places && one.mean_mm < other.mean_mm;
}

}  // namespace

LaidPlaces lay_on_axes(const std::vector<PlacesOnAxis>& all, const RigidFit& start, double hold) {
  RigidFit motion = start;
  std::vector<Miss> found = misses(all, motion, start);
  LaidPlaces best{motion, mean_distance(found), found.size()};
  for (int k = 0; k < most_steps && found.size() >= 3; ++k) {
    const RigidFit next = stepped(found, motion, hold);
    double moved = 0.0;
    for (const PlacesOnAxis& one : all)
      for (const Vec3& place : one.places) moved = std::max(moved, (next(place) - motion(place)).norm());
    motion = next;
    found = misses(all, motion, start);
    const LaidPlaces here{motion, mean_distance(found), found.size()};
    if (better(here, best)) best = here;
    if (moved < done_mm) break;
  }
  return best;
}

}  // namespace ostia::analysis
