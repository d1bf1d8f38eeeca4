// Distances between branches, and angles where they join.

#include "degrees.h"
#include "moving/motion_parts.h"
#include "names/tree_paths.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ostia::analysis {
namespace {

constexpr double least_arm_mm = 1.0;

/// How far it is along the tree from a place on one branch to a place on another:
/// base + |s_first - first| + |s_second - second|.
struct Way {
  double base = 0.0, first = 0.0, second = 0.0;
  double operator()(double s_first, double s_second) const {
    return base + std::abs(s_first - first) + std::abs(s_second - second);
  }
};

/// Where a branch hangs on another, at the proximal end of the first.
struct Hold {
  std::size_t branch = 0;
  double s_mm = 0.0;
};

/// Branches that begin where none leads to them, at the same root, hold on each other: the later on the
/// first.
std::vector<std::optional<Hold>> holds_of(const MovingTree& tree) {
  std::vector<std::optional<Hold>> holds(tree.branches.size());
  for (const Joint& joint : tree.joints) {
    const JointArm& from = joint.arms.front();
    for (const JointArm& arm : joint.arms)
      if (arm.distal && arm.s_mm == 0.0 && arm.branch != from.branch)
        holds[arm.branch] = {from.branch, from.s_mm};
  }
  return holds;
}

/// The branch and those that it hangs on, up to a root: where each is entered, and how far that is.
struct Step {
  std::size_t branch;
  double entered_mm, way_mm;
};
std::vector<Step> steps_up(const std::vector<std::optional<Hold>>& holds, std::size_t branch) {
  std::vector<Step> steps{{branch, 0.0, 0.0}};
  while (holds[steps.back().branch] && steps.size() <= holds.size()) {
    const Step& last = steps.back();
    const Hold& hold = *holds[last.branch];
    steps.push_back({hold.branch, hold.s_mm, last.way_mm + last.entered_mm});
  }
  return steps;
}

/// Nothing where no way leads from one to the other.
std::optional<Way> way_between(const std::vector<std::optional<Hold>>& holds, std::size_t first,
                               std::size_t second) {
  for (const Step& a : steps_up(holds, first))
    for (const Step& b : steps_up(holds, second)) {
      if (a.branch != b.branch) continue;
      if (a.branch == first) return Way{b.way_mm, b.entered_mm, 0.0};
      if (a.branch == second) return Way{a.way_mm, 0.0, a.entered_mm};
      return Way{a.way_mm + b.way_mm + std::abs(a.entered_mm - b.entered_mm), 0.0, 0.0};
    }
  return std::nullopt;
}

struct Nearest {
  double distance = not_measured, s_first = not_measured, s_second = not_measured;
};

/// A branch at one time.
struct AxisPair {
  const std::vector<double>& s_mm;
  const std::vector<Vec3>& points;
};

/// Of two pieces from `i` to `i + 1` on one line and `j` to `j + 1` on the other (Ericson 2005, 5.1.9).
void pieces(const AxisPair& a, std::size_t i, const AxisPair& b, std::size_t j, Nearest& nearest) {
  const Vec3 u = a.points[i + 1] - a.points[i], v = b.points[j + 1] - b.points[j];
  const Vec3 r = a.points[i] - b.points[j];
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ur = u.dot(r), vr = v.dot(r);
  if (uu == 0.0 || vv == 0.0) return;  // the neighbours' pieces have these points
  const double det = uu * vv - uv * uv;
  double s = det > 1e-12 * uu * vv ? std::clamp((uv * vr - ur * vv) / det, 0.0, 1.0) : 0.0;
  const double t = std::clamp((uv * s + vr) / vv, 0.0, 1.0);
  s = std::clamp((uv * t - ur) / uu, 0.0, 1.0);
  const double distance = (r + s * u - t * v).norm();
  if (distance < nearest.distance)
    nearest = {distance, a.s_mm[i] + s * (a.s_mm[i + 1] - a.s_mm[i]),
               b.s_mm[j] + t * (b.s_mm[j + 1] - b.s_mm[j])};
}

Nearest nearest_places(const AxisPair& a, const AxisPair& b, const std::optional<Way>& way,
                       double least_way_mm) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t at_a = 0, at_b = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    for (std::size_t j = 0; j < b.points.size(); ++j) {
      const double squared = (a.points[i] - b.points[j]).squaredNorm();
      if (squared < least && (!way || (*way)(a.s_mm[i], b.s_mm[j]) >= least_way_mm)) {
        least = squared;
        at_a = i;
        at_b = j;
      }
    }
  Nearest nearest;
  if (!std::isfinite(least)) return nearest;
  nearest = {std::sqrt(least), a.s_mm[at_a], b.s_mm[at_b]};
  const auto far_enough = [&](std::size_t i, std::size_t j) {
    return !way || (*way)(a.s_mm[i], b.s_mm[j]) >= least_way_mm;
  };
  for (std::size_t i = at_a - std::min<std::size_t>(at_a, 1); i <= at_a && i + 1 < a.points.size(); ++i)
    for (std::size_t j = at_b - std::min<std::size_t>(at_b, 1); j <= at_b && j + 1 < b.points.size(); ++j)
      if (far_enough(i, j) && far_enough(i + 1, j) && far_enough(i, j + 1) && far_enough(i + 1, j + 1))
        pieces(a, i, b, j, nearest);
  return nearest;
}

/// "LAD distal", where the branch goes on beyond the joint, else "D1".
std::string name_of(const MovingTree& tree, const Joint& joint, const JointArm& arm) {
  const auto arms = std::count_if(joint.arms.begin(), joint.arms.end(),
                                  [&](const JointArm& other) { return other.branch == arm.branch; });
  const std::string& name = tree.branches[arm.branch].name;
  if (arms < 2) return name;
  return name + (arm.distal ? " distal" : " proximal");
}

/// The template's abscissas of both ends of the piece that an arm's direction is taken from.
std::optional<std::array<double, 2>> piece_of(const MovingTree& tree, const Joint& joint, const JointArm& arm,
                                              double arm_mm) {
  const double length = tree.branches[arm.branch].s_mm.back(), sign = arm.distal ? 1.0 : -1.0;
  const double from = arm.s_mm + sign * joint.radius_mm;
  const double to = std::clamp(from + sign * arm_mm, 0.0, length);
  if (sign * (to - from) < least_arm_mm) return std::nullopt;
  return std::array<double, 2>{from, to};
}

double angle_between(const MovingTree& tree, const JointAngle& joint,
                     const std::array<std::array<double, 2>, 2>& ends, std::optional<std::size_t> phase) {
  std::array<Vec3, 2> directions;
  for (std::size_t k = 0; k < 2; ++k) {
    const MovingBranch& branch = tree.branches[(k == 0 ? joint.first : joint.second).branch];
    const std::vector<Vec3>& points = phase ? shape_of(branch)[*phase] : branch.rest;
    directions[k] =
        at_abscissa(branch.s_mm, points, ends[k][1]) - at_abscissa(branch.s_mm, points, ends[k][0]);
  }
  return degrees * std::atan2(directions[0].cross(directions[1]).norm(), directions[0].dot(directions[1]));
}

}  // namespace

std::vector<BranchDistance> branch_distances(const MovingTree& tree, const MotionMeasureOptions& options,
                                             const core::TaskContext& task) {
  const auto holds = holds_of(tree);
  std::vector<BranchDistance> result;
  for (std::size_t a = 0; a < tree.branches.size(); ++a)
    for (std::size_t b = a + 1; b < tree.branches.size(); ++b) result.push_back({a, b, {}, {}, {}});
  const std::size_t times = tree.phases.size() + 1;  // the last is the template
  for (std::size_t done = 0; done < result.size(); ++done) {
    task.throw_if_cancelled();
    BranchDistance& pair = result[done];
    const MovingBranch &a = tree.branches[pair.first], &b = tree.branches[pair.second];
    const std::optional<Way> way = way_between(holds, pair.first, pair.second);
    std::vector<Nearest> nearest(times);
    core::parallel_for(times, 4, [&](std::size_t k) {
      const bool at_rest = k + 1 == times;
      nearest[k] = nearest_places({a.s_mm, at_rest ? a.rest : a.places[k]},
                                  {b.s_mm, at_rest ? b.rest : b.places[k]}, way, options.least_way_mm);
    });
    const auto fill = [&](TimeCurve& curve, double Nearest::*value) {
      curve.at_template = nearest.back().*value;
      for (std::size_t k = 0; k + 1 < times; ++k) curve.values.push_back(nearest[k].*value);
    };
    fill(pair.distance, &Nearest::distance);
    fill(pair.s_first, &Nearest::s_first);
    fill(pair.s_second, &Nearest::s_second);
    task.set_progress(static_cast<double>(done + 1) / static_cast<double>(result.size()));
  }
  return result;
}

std::vector<JointAngle> joint_angles(const MovingTree& tree, const MotionMeasureOptions& options,
                                     std::vector<std::string>& warnings) {
  std::vector<JointAngle> angles;
  for (const Joint& joint : tree.joints)
    for (std::size_t i = 0; i < joint.arms.size(); ++i)
      for (std::size_t j = i + 1; j < joint.arms.size(); ++j) {
        JointAngle one{joint.node, joint.arms[i], joint.arms[j], "", {}};
        one.name = name_of(tree, joint, one.first) + " | " + name_of(tree, joint, one.second);
        const auto first = piece_of(tree, joint, one.first, options.arm_mm);
        const auto second = piece_of(tree, joint, one.second, options.arm_mm);
        if (!first || !second) {
          warnings.push_back("the angle " + one.name +
                             " is not measured: an arm is shorter than the joint's radius and 1 mm");
          one.angle.values.assign(tree.phases.size(), not_measured);
        } else {
          one.angle.at_template = angle_between(tree, one, {*first, *second}, std::nullopt);
          for (std::size_t k = 0; k < tree.phases.size(); ++k)
            one.angle.values.push_back(angle_between(tree, one, {*first, *second}, k));
        }
        angles.push_back(std::move(one));
      }
  return angles;
}

}  // namespace ostia::analysis
