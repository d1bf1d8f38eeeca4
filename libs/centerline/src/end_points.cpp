#include "ostia/centerline/end_points.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

// An opening is a hole in the wall when an inscribed sphere this many times its size comes within half its
// radius of it: across a vessel's end the vessel is about as wide as the opening.
constexpr double hole_in_wall = 2.0;
// A given point belongs to an opening within this part of the opening's radius.
constexpr double near_opening = 0.5;
// A given point may lie this part of the inscribed radius outside its sphere (a click on the wall, a point
// just behind a cap).
constexpr double outside_tolerance = 0.3;

const Opening* opening_near(const std::vector<Opening>& openings, const Vec3& point) {
  const Opening* best = nullptr;
  double best_distance = 0.0;
  for (const Opening& opening : openings) {
    const double distance = (opening.centre - point).norm();
    if (distance > near_opening * opening.radius || (best && distance >= best_distance)) continue;
    best = &opening;
    best_distance = distance;
  }
  return best;
}

EndPoint end_at_opening(const InnerVoronoi& diagram, const Opening& opening) {
  return {snap(diagram, opening.centre).point, opening.centre, true};
}

/// The sphere that holds a point outside the surface deepest once all are grown by the tolerance; -1 when
/// none does. The nearest sphere alone will not do: in the corners of a flat end there are small ones.
std::int32_t just_behind(const InnerVoronoi& diagram, const Vec3& point) {
  std::int32_t best = -1;
  double depth = 0.0;
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    const double here = (1.0 + outside_tolerance) * diagram.radius[i] - (diagram.points[i] - point).norm();
    if (here > depth) {
      depth = here;
      best = static_cast<std::int32_t>(i);
    }
  }
  return best;
}

EndPoint end_at_point(const InnerVoronoi& diagram, const std::vector<Opening>& ends, const Vec3& point,
                      const std::string& role) {
  if (!point.allFinite()) throw InvalidInput(role + " has a coordinate that is not finite");
  if (const Opening* opening = opening_near(ends, point)) return end_at_opening(diagram, *opening);
  const Snapped snapped = snap(diagram, point);
  if (snapped.depth >= 0.0)
    return {snapped.point, diagram.points[static_cast<std::size_t>(snapped.point)], false};
  const std::int32_t behind = just_behind(diagram, point);
  if (behind < 0) {
    throw GeometryError(describe_point(role, point) + " lies outside the surface, " +
                        core::significant_text(-snapped.depth, 4) +
                        " mm from the nearest inscribed sphere: give a point inside the lumen");
  }
  return {behind, diagram.points[static_cast<std::size_t>(behind)], false};
}

bool is_hole_in_wall(const InnerVoronoi& diagram, const Opening& opening) {
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    const double radius = diagram.radius[i];
    if (radius < hole_in_wall * opening.radius) continue;
    if (radius - (diagram.points[i] - opening.centre).norm() > -0.5 * opening.radius) return true;
  }
  return false;
}

// Openings that lie across a vessel, not in its wall.
std::vector<Opening> vessel_ends(const InnerVoronoi& diagram, const std::vector<Opening>& openings,
                                 std::vector<std::string>& warnings) {
  std::vector<Opening> ends;
  for (const Opening& opening : openings) {
    if (is_hole_in_wall(diagram, opening))
      warnings.push_back(describe_point("hole in the wall at", opening.centre) + ": not taken as an end");
    else
      ends.push_back(opening);
  }
  return ends;
}

std::vector<EndPoint> remaining_ends(const InnerVoronoi& diagram, const std::vector<Opening>& ends,
                                     const EndPoint& source) {
  std::vector<EndPoint> result;
  for (const Opening& opening : ends) {
    const EndPoint end = end_at_opening(diagram, opening);
    if (end.diagram_point == source.diagram_point || end.position == source.position) continue;
    result.push_back(end);
  }
  return result;
}

}  // namespace

std::string describe_point(const std::string& role, const Vec3& point) {
  return role + " (" + core::significant_text(point.x(), 6) + ", " + core::significant_text(point.y(), 6) +
         ", " + core::significant_text(point.z(), 6) + ") mm";
}

std::vector<Opening> find_openings(const geometry::TriMesh& lumen) {
  return find_openings(lumen, geometry::boundary_loops(lumen));
}

std::vector<Opening> find_openings(const geometry::TriMesh& lumen,
                                   const std::vector<std::vector<std::int32_t>>& loops) {
  std::vector<Opening> openings;
  for (const auto& loop : loops) {
    Vec3 moment = Vec3::Zero();
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3& a = lumen.points[static_cast<std::size_t>(loop[i])];
      const Vec3& b = lumen.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
      moment += (b - a).norm() * 0.5 * (a + b);
      length += (b - a).norm();
    }
    if (length > 0.0) openings.push_back({moment / length, length / (2.0 * std::numbers::pi)});
  }
  std::stable_sort(openings.begin(), openings.end(),
                   [](const Opening& a, const Opening& b) { return a.radius > b.radius; });
  return openings;
}

Snapped snap(const InnerVoronoi& diagram, const Vec3& query) {
  Snapped best;
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    const double depth = diagram.radius[i] - (diagram.points[i] - query).norm();
    if (best.point < 0 || depth > best.depth) best = {static_cast<std::int32_t>(i), depth};
  }
  return best;
}

EndPoints choose_ends(const InnerVoronoi& diagram, const std::vector<Opening>& openings,
                      const std::optional<Vec3>& source, const std::vector<Vec3>& targets) {
  EndPoints result;
  const std::vector<Opening> ends = vessel_ends(diagram, openings, result.warnings);
  if (!source && ends.empty())
    throw InvalidInput("the surface has no open end to start from: give a source point inside the lumen");
  result.source =
      source ? end_at_point(diagram, ends, *source, "source") : end_at_opening(diagram, ends.front());
  if (targets.empty()) {
    result.targets = remaining_ends(diagram, ends, result.source);
    if (result.targets.empty())
      throw InvalidInput(
          "the surface has no open end besides the source's: give target points inside the lumen");
  }
  for (std::size_t i = 0; i < targets.size(); ++i)
    result.targets.push_back(end_at_point(diagram, ends, targets[i], "target " + std::to_string(i)));
  for (std::size_t i = 0; i < result.targets.size(); ++i)
    if (result.targets[i].diagram_point == result.source.diagram_point)
      throw GeometryError(describe_point("target " + std::to_string(i), result.targets[i].position) +
                          " belongs to the same inscribed sphere as the source: give points farther apart");
  return result;
}

}  // namespace ostia::centerline
