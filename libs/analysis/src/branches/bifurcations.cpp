#include "ostia/analysis/bifurcations.h"

#include "branches/branch_tracts.h"

#include "ostia/core/error.h"
#include "ostia/geometry/line_geometry.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace ostia::analysis {
namespace {

using geometry::Centerline;
using geometry::LinePlace;
using geometry::LineWay;

constexpr double one_start_mm = 1e-6;

double cotangent(const Vec3& a, const Vec3& corner, const Vec3& b) {
  const double sine = (a - corner).cross(b - corner).norm();
  return sine > 0.0 ? (a - corner).dot(b - corner) / sine : 0.0;
}

/// Of a polygon that need not be plane: its corners' normals with the weights of mean value coordinates about
/// the bifurcation's origin. Zero where all corners lie in line.
Vec3 polygon_normal(const std::vector<Vec3>& corners, const Vec3& origin) {
  Vec3 sum = Vec3::Zero();
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &before = corners[(i + n - 1) % n], &here = corners[i], &after = corners[(i + 1) % n];
    const Vec3 normal = (after - here).cross(before - here);
    const double distance = (here - origin).squaredNorm();
    if (!(normal.norm() > 0.0) || !(distance > 0.0)) continue;
    const double weight = (cotangent(before, here, origin) + cotangent(origin, here, after)) / distance;
    sum += weight * normal.normalized();
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : sum;
}

/// Each two tracts span a polygon: both starts, unless they are one, and both ends.
Vec3 plane_normal(const std::vector<const BranchTract*>& tracts, const Vec3& origin) {
  Vec3 first = Vec3::Zero(), sum = Vec3::Zero();
  for (std::size_t i = 0; i < tracts.size(); ++i) {
    for (std::size_t j = i + 1; j < tracts.size(); ++j) {
      const std::vector<Vec3>&a = tracts[i]->axis.points, &b = tracts[j]->axis.points;
      std::vector<Vec3> corners{a.front(), a.back(), b.back()};
      if ((a.front() - b.front()).norm() >= one_start_mm) corners.push_back(b.front());
      const Vec3 normal = polygon_normal(corners, origin);
      if (first.isZero(0.0)) first = normal;
      sum += normal.dot(first) < 0.0 ? Vec3(-normal) : normal;
    }
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : sum;
}

std::optional<BifurcationSystem> system_of(const BranchTracts& tracts, std::int32_t group) {
  const std::vector<const BranchTract*>& own = tracts.distinct(group);
  WeightedPlace origin;
  for (const BranchTract* tract : own) {
    origin.add(tract->axis.points.front(), tract->axis.radius.front());
    origin.add(tract->axis.points.back(), tract->axis.radius.back());
  }
  BifurcationSystem system;
  system.group = group;
  system.origin = origin.mean();
  system.normal = plane_normal(own, system.origin);
  if (system.normal.isZero(0.0)) return std::nullopt;
  Vec3 up = Vec3::Zero();
  for (const BranchTract* tract : own) {
    const Vec3 along = tract->axis.points.back() - tract->axis.points.front();
    const Vec3 in_plane = along - along.dot(system.normal) * system.normal;
    const double radius = tract->axis.radius.back();
    if (in_plane.norm() > 0.0) up += radius * radius * in_plane.normalized();
  }
  if (!(up.norm() > 0.0)) return std::nullopt;
  system.up_normal = up.normalized();
  return system;
}

double angle_of_vectors(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

BifurcationVector vector_of(const BranchTracts& tracts, std::int32_t group, const BifurcationSystem& system,
                            LineWay way) {
  WeightedPlace near, far;
  for (const BranchTract* tract : tracts.distinct(group)) {
    const Centerline& axis = tract->axis;
    const LinePlace last{axis.size() - 1, 0.0};
    const LinePlace from = way == LineWay::upstream ? last : LinePlace{};
    const LinePlace end = way == LineWay::upstream ? LinePlace{} : last;
    const LinePlace to = geometry::touching_place(axis, from, way).value_or(end);
    near.add(geometry::value_at(axis.points, from), geometry::value_at(axis.radius, from));
    far.add(geometry::value_at(axis.points, to), geometry::value_at(axis.radius, to));
  }
  BifurcationVector out;
  out.group = group;
  out.bifurcation = system.group;
  out.downstream = way == LineWay::downstream;
  out.point = out.downstream ? near.mean() : far.mean();
  out.vector = out.downstream ? Vec3(far.mean() - near.mean()) : Vec3(near.mean() - far.mean());
  out.out_of_plane = out.vector.dot(system.normal) * system.normal;
  out.in_plane = out.vector - out.out_of_plane;
  const double side = out.in_plane.cross(system.up_normal).dot(system.normal);
  out.in_plane_rad = (side < 0.0 ? -1.0 : 1.0) * angle_of_vectors(out.in_plane, system.up_normal);
  out.out_of_plane_rad = 0.5 * std::numbers::pi - angle_of_vectors(out.vector, system.normal);
  return out;
}

/// Mean of a value of the inner points, weighted by half the pieces at each.
double mean_along(const std::vector<Vec3>& points, const std::vector<double>& values, std::size_t rim) {
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = rim; i + rim < points.size(); ++i) {
    const double piece = 0.5 * ((points[i] - points[i - 1]).norm() + (points[i + 1] - points[i]).norm());
    sum += piece * values[i];
    weight += piece;
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

/// A branch's line in steps of one inscribed sphere, and its end: what bends within a sphere is noise.
struct Steps {
  std::vector<Vec3> points, normals;
};
Steps steps_along(const Centerline& axis) {
  std::vector<LinePlace> places = geometry::sphere_steps(axis, {});
  places.push_back({axis.size() - 1, 0.0});
  Steps out;
  for (const LinePlace& place : places) {
    out.points.push_back(geometry::value_at(axis.points, place));
    out.normals.push_back(axis.frames[place.piece].normal);
  }
  return out;
}

BranchGeometry geometry_of(const BranchTracts& tracts, std::int32_t group) {
  BranchGeometry out;
  out.group = group;
  WeightedPlace first, last;
  for (const BranchTract& tract : tracts.all(group)) {
    const Centerline& axis = tract.axis;
    const Steps steps = steps_along(axis);
    const geometry::LineGeometry bends = geometry::line_geometry(steps.points, steps.normals);
    out.length_mm += geometry::length(axis.points);
    out.mean_radius_mm +=
        std::accumulate(axis.radius.begin(), axis.radius.end(), 0.0) / static_cast<double>(axis.size());
    out.curvature += mean_along(steps.points, bends.curvature, 1);
    out.torsion += mean_along(steps.points, bends.torsion, 2);
    first.add(axis.points.front(), axis.radius.front());
    last.add(axis.points.back(), axis.radius.back());
  }
  const auto count = static_cast<double>(tracts.all(group).size());
  for (double* value : {&out.length_mm, &out.mean_radius_mm, &out.curvature, &out.torsion}) *value /= count;
  const double apart = (last.mean() - first.mean()).norm();
  out.tortuosity = apart > 0.0 ? out.length_mm / apart - 1.0 : 0.0;
  return out;
}

}  // namespace

BifurcationMeasures measure_bifurcations(const geometry::BranchedLines& lines) {
  if (lines.lines.empty()) throw InvalidInput("there are no lines whose bifurcations could be measured");
  const BranchTracts tracts(lines);
  BifurcationMeasures out;
  for (const std::int32_t group : tracts.groups(true)) {
    const std::optional<BifurcationSystem> system = system_of(tracts, group);
    if (!system) {
      out.warnings.push_back("bifurcation " + std::to_string(group) +
                             " has no plane: its tracts lie in one line");
      continue;
    }
    out.systems.push_back(*system);
    for (const LineWay way : {LineWay::upstream, LineWay::downstream})
      for (const std::int32_t branch : tracts.neighbours(group, way))
        out.vectors.push_back(vector_of(tracts, branch, *system, way));
  }
  for (const std::int32_t group : tracts.groups(false)) out.branches.push_back(geometry_of(tracts, group));
  return out;
}

double angle_between_branches(const BifurcationMeasures& measures, std::int32_t bifurcation) {
  std::vector<Vec3> leaving;
  for (const BifurcationVector& one : measures.vectors)
    if (one.bifurcation == bifurcation && one.downstream) leaving.push_back(one.vector);
  double widest = 0.0;
  for (std::size_t i = 0; i < leaving.size(); ++i)
    for (std::size_t j = i + 1; j < leaving.size(); ++j)
      widest = std::max(widest, angle_of_vectors(leaving[i], leaving[j]));
  return widest;
}

}  // namespace ostia::analysis
