#include "branches/branch_metrics.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

/// A tract and, where they are blanked, those before and behind it.
geometry::Centerline with_bifurcations(const geometry::BranchedLine& line, std::size_t tract) {
  geometry::Tract whole = line.tracts[tract];
  if (tract > 0 && line.tracts[tract - 1].blanked) {
    const auto& before = line.tracts[tract - 1].places;
    whole.places.insert(whole.places.begin(), before.begin(), before.end() - 1);
  }
  if (tract + 1 < line.tracts.size() && line.tracts[tract + 1].blanked) {
    const auto& behind = line.tracts[tract + 1].places;
    whole.places.insert(whole.places.end(), behind.begin() + 1, behind.end());
  }
  return geometry::tract_axis(line, whole);
}

Vec3 part_across(const Vec3& v, const Vec3& direction) {
  return v - v.dot(direction) * direction;
}

}  // namespace

BranchMetrics::BranchMetrics(const geometry::BranchedLines& lines, const BranchTracts& tracts,
                             std::int32_t group) {
  for (const BranchTract& one : tracts.all(group)) {
    geometry::Centerline axis = with_bifurcations(lines.lines[one.line], one.tract);
    geometry::BallLine tube(axis);
    lines_.push_back({std::move(axis), std::move(tube)});
  }
}

BranchPlace BranchMetrics::at(const Vec3& x) const {
  Vec3 point = Vec3::Zero(), direction = Vec3::Zero(), normal = Vec3::Zero();
  BranchPlace out;
  double weights = 0.0;
  out.distance_mm = INFINITY;
  for (const Line& line : lines_) {
    const geometry::LinePlace place = line.tube.nearest(x).place;
    const double radius = geometry::value_at(line.axis.radius, place), weight = radius * radius;
    const Vec3 here = geometry::value_at(line.axis.points, place);
    const std::size_t next = std::min(place.piece + 1, line.axis.size() - 1);
    const Vec3 normal_here =
        (1.0 - place.t) * line.axis.frames[place.piece].normal + place.t * line.axis.frames[next].normal;
    point += weight * here;
    direction += weight * geometry::direction_at(line.axis, place);
    normal += weight * normal_here;
    out.abscissa_mm += weight * geometry::value_at(line.axis.abscissa, place);
    out.distance_mm = std::min(out.distance_mm, (x - here).norm());
    weights += weight;
  }
  out.abscissa_mm /= weights;
  direction.normalize();
  const Vec3 from = part_across(normal, direction), to = part_across(x - point / weights, direction);
  out.angle_rad = std::atan2(to.cross(from).dot(direction), to.dot(from));
  return out;
}

}  // namespace ostia::analysis
