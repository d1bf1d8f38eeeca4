#include "editing/edit_kinds.h"
#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::lumen {
namespace {

using std::numbers::pi;
constexpr double pushed_radius_mm = 0.2;  // a wall pushed inwards stops there
constexpr double present_share = 0.65;    // of the spacing: a sample that near stands for a place
constexpr double contact_mm = 1e-9;

enum class Push { outwards, inwards };

void check(const WallPush& edit, const std::string& what) {
  check_points(edit.path, 1, what);
  if (!(edit.radius_mm > 0.0 && edit.radius_mm <= 10.0))
    throw InvalidInput(what + ": the ball's radius is " + core::mm_text(edit.radius_mm) +
                       "; it must be above 0 and at most 10 mm");
}

// The nearest point of the way that the ball's centre goes.
Vec3 nearest_centre(const std::vector<Vec3>& path, const Vec3& place) {
  Vec3 nearest = path.front();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 way = path[i + 1] - path[i];
    const double squared = way.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((place - path[i]).dot(way) / squared, 0.0, 1.0) : 0.0;
    const Vec3 on = path[i] + t * way;
    if ((on - place).squaredNorm() < (nearest - place).squaredNorm()) nearest = on;
  }
  return nearest;
}

struct Ball {
  std::vector<Vec3> path;
  double radius_mm = 0.0;
  Push push = Push::outwards;
};

// Where a place of the wall comes to lie.
struct Pushed {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitX();  // of the ball there
  double moved_mm = 0.0;
  bool stopped = false;  // by the axis
};

// The place moves along its ray from the axis until the ball no longer covers it. The distance to the ball's
// way changes no faster than the place moves, so that steps of what is missing never overshoot.
Pushed pushed(const Ball& ball, const Vec3& centre, const Vec3& place) {
  Pushed result{place, Vec3::UnitX(), 0.0, false};
  const double start = (place - centre).norm();
  const Vec3 ray = (place - centre) / std::max(start, 1e-12);
  // A ball that reaches over the axis does not push the far wall inwards.
  if (ball.push == Push::inwards && !(ray.dot(nearest_centre(ball.path, place) - centre) > 0.0))
    return result;
  double t = start;
  for (int step = 0; step < 400; ++step) {
    result.position = centre + t * ray;
    const double missing =
        ball.radius_mm - (result.position - nearest_centre(ball.path, result.position)).norm();
    if (missing < contact_mm) break;
    t += ball.push == Push::outwards ? missing : -missing;
    if (ball.push == Push::inwards && t < pushed_radius_mm) {
      t = std::min(start, pushed_radius_mm);
      result.position = centre + t * ray;
      result.stopped = true;
      break;
    }
  }
  result.moved_mm = std::abs(t - start);
  const Vec3 out = result.position - nearest_centre(ball.path, result.position);
  result.normal = (ball.push == Push::outwards ? out : Vec3(-out)).normalized();
  if (result.stopped || !(result.normal.dot(ray) > 0.1)) result.normal = ray;
  return result;
}

// The wall's normal turns into the ball's over the first half spacing of the way that it is pushed.
Vec3 blended(const Vec3& wall, const Pushed& moved, double spacing_mm) {
  const double share = std::min(1.0, moved.moved_mm / (0.5 * spacing_mm));
  const Vec3 sum = (1.0 - share) * wall + share * moved.normal;
  return sum.norm() > 1e-6 ? Vec3(sum.normalized()) : moved.normal;
}

// Signed distance of a place from the wall by the planes of its nearest samples: negative in the lumen.
double side_of(WallEdit& work, const Vec3& place) {
  std::vector<std::pair<double, double>> planes;  // squared distance, height above the plane
  for (const OwnedStretch& stretch : work.stretches())
    for (const SurfaceSample& sample : work.of(stretch.owner).vessel().samples) {
      const Vec3 offset = place - sample.position;
      planes.emplace_back(offset.squaredNorm(), offset.dot(sample.normal));
    }
  const std::size_t count = std::min<std::size_t>(4, planes.size());
  std::partial_sort(planes.begin(), planes.begin() + static_cast<std::ptrdiff_t>(count), planes.end());
  double sum = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = 1.0 / (planes[i].first + 1e-9);
    sum += weight * planes[i].second;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

// The wall between samples: where the ray from the axis meets the planes of the samples around.
struct Estimate {
  Vec3 position = Vec3::Zero(), normal = Vec3::UnitX();
};
std::optional<Estimate> wall_at(const std::vector<WallPlace>& wall, const AxisCurve& axis, double s_mm,
                                double theta, double spacing_mm) {
  const Vec3 centre = axis.point(s_mm), ray = geometry::radial_direction(axis.frame(s_mm), theta);
  double sum = 0.0, rho = 0.0;
  Vec3 normal = Vec3::Zero();
  for (const WallPlace& place : wall) {
    const double aside = place.rho_mm * angle_between(place.theta, theta);
    const double distance = std::hypot(place.sample->s_mm - s_mm, aside) / (2.0 * spacing_mm);
    const double towards = ray.dot(place.sample->normal);
    if (distance >= 1.0 || towards < 0.2) continue;
    const double meets = (place.sample->position - centre).dot(place.sample->normal) / towards;
    if (!(meets > 0.0) || meets > 2.0 * place.rho_mm) continue;
    const double weight = std::pow(1.0 - distance, 2) / (distance * distance + 1e-3);
    sum += weight;
    rho += weight * meets;
    normal += weight * place.sample->normal;
  }
  if (!(sum > 0.0) || !(normal.norm() > 1e-9)) return std::nullopt;
  return Estimate{centre + rho / sum * ray, normal.normalized()};
}

struct PushedStretch {
  double from_mm = 0.0, to_mm = 0.0;  // abscissas that the ball can touch
};

void push_samples(WallChange& change, const OwnedStretch& owned, const PushedStretch& reach, const Ball& ball,
                  int& stopped) {
  const VesselLumen& vessel = change.vessel();
  const AxisCurve& axis = *vessel.axis;
  for (std::size_t i = 0; i < vessel.samples.size(); ++i) {
    const SurfaceSample& before = vessel.samples[i];
    if (before.origin == SampleOrigin::cap) continue;
    if (before.s_mm < std::max(owned.from_mm, reach.from_mm) || before.s_mm > reach.to_mm ||
        before.s_mm >= owned.to_mm)
      continue;
    const Pushed moved = pushed(ball, axis.point(before.s_mm), before.position);
    if (moved.moved_mm < 1e-6) continue;
    SurfaceSample sample = before;
    const double spacing = sample_spacing_mm(vessel, (before.position - axis.point(before.s_mm)).norm());
    sample.position = moved.position;
    sample.normal = blended(before.normal, moved, spacing);
    sample.origin = SampleOrigin::edit;
    stopped += moved.stopped ? 1 : 0;
    change.remove(i);
    change.add(sample);
  }
}

// Samples where the pushed wall has none: the ball may be smaller than their distance, and the wall before it
// is longer than it was.
void add_between(WallChange& change, const OwnedStretch& owned, const PushedStretch& reach,
                 const Ball& ball) {
  const VesselLumen& vessel = change.vessel();
  const AxisCurve& axis = *vessel.axis;
  const double from = std::max({0.0, owned.from_mm, reach.from_mm});
  const double to = std::min({axis.length(), owned.to_mm, reach.to_mm});
  const std::vector<WallPlace> wall = wall_places(vessel, from - 3.0, to + 3.0);
  if (wall.empty() || !(to > from)) return;
  double mean = 0.0;
  for (const WallPlace& place : wall) mean += place.rho_mm;
  mean /= static_cast<double>(wall.size());
  const double spacing = std::min(sample_spacing_mm(vessel, mean), std::max(0.3, 0.7 * ball.radius_mm));
  std::vector<Vec3> present;
  for (const SurfaceSample& sample : change.kept()) present.push_back(sample.position);
  for (const SurfaceSample& sample : change.added()) present.push_back(sample.position);
  const auto steps = static_cast<int>(std::ceil((to - from) / (0.5 * spacing)));
  const auto around = static_cast<int>(std::clamp(std::ceil(2.0 * pi * mean / (0.5 * spacing)), 12.0, 96.0));
  for (int i = 0; i <= steps; ++i) {
    const double s = from + (to - from) * i / steps;
    for (int k = 0; k < around; ++k) {
      const auto place = wall_at(wall, axis, s, 2.0 * pi * k / around, sample_spacing_mm(vessel, mean));
      if (!place) continue;
      const Pushed moved = pushed(ball, axis.point(s), place->position);
      if (moved.moved_mm < 0.02) continue;
      const bool stands_there = std::any_of(present.begin(), present.end(), [&](const Vec3& other) {
        return (other - moved.position).norm() < present_share * spacing;
      });
      if (stands_there) continue;
      SurfaceSample sample;
      sample.position = moved.position;
      sample.normal = blended(place->normal, moved, spacing);
      sample.s_mm = s;
      sample.origin = SampleOrigin::edit;
      change.add(sample);
      present.push_back(sample.position);
    }
  }
}

// The abscissas that the ball can touch: those of its way's feet, by its radius and a little more; in a bend
// the wall on the inner side is shorter than the axis.
PushedStretch reach_of(const AxisCurve& axis, const WallPush& edit, const std::string& what) {
  const std::vector<geometry::AxisFoot> feet = feet_along(axis, edit.path, std::nullopt, what);
  PushedStretch reach{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const geometry::AxisFoot& foot : feet) {
    const double bend = foot.rho_mm * axis.curvature_vector(foot.s_mm).norm();
    const double most = 1.0 + edit.radius_mm * (1.0 + std::min(2.0, bend));
    reach.from_mm = std::min(reach.from_mm, foot.s_mm - most);
    reach.to_mm = std::max(reach.to_mm, foot.s_mm + most);
  }
  return reach;
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const WallPush& edit) {
  WallEdit work(model, edit.vessel, "wall.push");
  check(edit, work.what());
  const PushedStretch reach = reach_of(*vessel(model, edit.vessel).axis, edit, work.what());
  const Ball ball{edit.path, edit.radius_mm,
                  side_of(work, edit.path.front()) < 0.0 ? Push::outwards : Push::inwards};
  int stopped = 0;
  for (const OwnedStretch& owned : work.stretches()) {
    WallChange& change = work.of(owned.owner);
    push_samples(change, owned, reach, ball, stopped);
    add_between(change, owned, reach, ball);
    change.remove_crowded(0.3);
  }
  if (stopped > 0)
    work.notes.push_back("the wall was stopped " + core::mm_text(pushed_radius_mm) + " before the axis at " +
                         std::to_string(stopped) + " places; a wall never passes its axis");
  EditOutcome outcome = std::move(work).outcome();
  if (outcome.changes.empty()) outcome.notes.push_back("the ball did not touch the wall; nothing changed");
  return outcome;
}

}  // namespace ostia::lumen
