#include "flow_extension/axes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

bool is_root(const geometry::VesselTree& tree, const EndPlane& plane) {
  return std::none_of(tree.segments.begin(), tree.segments.end(),
                      [&](const geometry::TreeSegment& s) { return s.to == plane.node; });
}

/// The segment that begins (root) or ends at the plane's node; the number of segments where there is none.
std::size_t segment_at(const geometry::VesselTree& tree, const EndPlane& plane) {
  const bool root = is_root(tree, plane);
  std::size_t i = 0;
  while (i < tree.segments.size() && (root ? tree.segments[i].from : tree.segments[i].to) != plane.node) ++i;
  return i;
}

/// Points from the end of the axis inward, with radii; on into the parents until `enough` is behind the
/// plane.
geometry::Centerline inward(const geometry::VesselTree& tree, const EndPlane& plane, double enough) {
  geometry::Centerline line;
  std::size_t at = segment_at(tree, plane);
  const bool root = is_root(tree, plane);
  double reach = 0.0;
  for (std::size_t guard = 0; guard < tree.segments.size(); ++guard) {
    const geometry::Centerline& axis = tree.segments[at].axis;
    const std::size_t skip = line.points.empty() ? 0 : 1;  // the point that both share
    for (std::size_t k = skip; k < axis.size(); ++k) {
      const std::size_t i = root ? k : axis.size() - 1 - k;
      line.points.push_back(axis.points[i]);
      line.radius.push_back(axis.radius[i]);
    }
    if (line.points.size() < 2)
      throw InvalidInput("flow extensions: segment " + std::to_string(tree.segments[at].id) +
                         " has fewer than two points");
    const double end = geometry::closest(line.points, plane.origin).abscissa;
    reach = geometry::length(line.points) - end;
    if (root || reach >= enough) break;
    const std::int32_t node = tree.segments[at].from;
    const auto parent = std::find_if(tree.segments.begin(), tree.segments.end(),
                                     [&](const geometry::TreeSegment& s) { return s.to == node; });
    if (parent == tree.segments.end()) break;
    at = static_cast<std::size_t>(parent - tree.segments.begin());
  }
  return line;
}

double radius_at(const geometry::Centerline& line, const geometry::PolylineLocation& place) {
  return (1.0 - place.t) * line.radius[place.segment] + place.t * line.radius[place.segment + 1];
}

}  // namespace

EndPlane at_node_of(const geometry::VesselTree& tree, const EndPlane& plane) {
  EndPlane best = plane;
  const auto distance_of = [&](std::int32_t node) {
    EndPlane there = plane;
    there.node = node;
    const std::size_t at = segment_at(tree, there);
    if (at == tree.segments.size() || tree.segments[at].axis.size() < 2 ||
        tree.segments[at].axis.radius.size() != tree.segments[at].axis.size())
      return std::numeric_limits<double>::infinity();
    const std::vector<Vec3>& points = tree.segments[at].axis.points;
    return (geometry::closest(points, plane.origin).point - plane.origin).norm();
  };
  const double reach = 2.0 * plane.radius_mm;
  const std::vector<std::int32_t> starts = geometry::roots(tree), leaves = geometry::ends(tree);
  const auto has = [&](const std::vector<std::int32_t>& ids) {
    return std::find(ids.begin(), ids.end(), plane.node) != ids.end();
  };
  if (has(plane.kind == geometry::FaceKind::inlet ? starts : leaves) && distance_of(plane.node) <= reach)
    return best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<std::int32_t>* ids : {&starts, &leaves})
    for (const std::int32_t id : *ids) {
      const double away = (geometry::node(tree, id).position - plane.origin).norm();
      if (away >= nearest || distance_of(id) > reach) continue;
      nearest = away;
      best.node = id;
    }
  if (nearest == std::numeric_limits<double>::infinity())
    throw InvalidInput("flow extensions: no axis of the tree comes near " + end_name(plane) +
                       "; give the tree that the surface was clipped with, or one of the cut lumen");
  return best;
}

AxisEnd axis_end(const geometry::VesselTree& tree, const EndPlane& plane, double diameter) {
  const geometry::Centerline line = inward(tree, plane, diameter);
  const double total = geometry::length(line.points);
  const double s = std::min(geometry::closest(line.points, plane.origin).abscissa, 0.9 * total);
  const double far = std::min(s + diameter, total);
  const Vec3 outer = geometry::at_abscissa(line.points, s).point;
  const Vec3 inner = geometry::at_abscissa(line.points, far).point;
  const Vec3 middle = geometry::at_abscissa(line.points, 0.5 * (s + far)).point;
  if (!((outer - inner).norm() > 1e-9 * (1.0 + total)))
    throw InvalidInput("flow extensions: the axis of vessel " + plane.vessel +
                       " is too short to have a direction");
  AxisEnd end;
  end.direction = (outer - inner).normalized();
  const Vec3 bow = 0.5 * (outer + inner) - middle;  // points to the inside of the bend
  const Vec3 across = bow - bow.dot(end.direction) * end.direction;
  if (across.norm() > 1e-3 * diameter) end.turning = across.normalized();
  return end;
}

AxisPoint axis_at_section(const geometry::VesselTree& tree, const EndPlane& plane) {
  const geometry::Centerline line = inward(tree, plane, 0.0);
  const auto place = geometry::closest(line.points, plane.origin);
  return {place.point, radius_at(line, place)};
}

bool extend_axis(geometry::VesselTree& tree, const EndPlane& plane, const std::vector<Vec3>& points,
                 const std::vector<double>& radii) {
  const auto meets = [&](const geometry::TreeSegment& s) {
    return s.from == plane.node || s.to == plane.node;
  };
  if (std::count_if(tree.segments.begin(), tree.segments.end(), meets) != 1) return false;
  geometry::TreeSegment& segment = tree.segments[segment_at(tree, plane)];
  geometry::Centerline line = segment.axis;
  const bool root = is_root(tree, plane);
  const Vec3 first_normal = line.frames.empty() || root ? Vec3::Zero() : line.frames.front().normal;
  if (root) {
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.radius.begin(), line.radius.end());
  }
  const auto cut = geometry::closest(line.points, plane.origin);
  const double radius = radius_at(line, cut);
  const std::vector<double> along = geometry::abscissas(line.points);
  const double tiny = 1e-6 * (1.0 + along.back());
  std::size_t kept = 1;  // the inner node's own point stays whatever happens
  while (kept < line.points.size() && along[kept] < cut.abscissa - tiny) ++kept;
  line.points.resize(kept);
  line.radius.resize(kept);
  const auto add = [&](const Vec3& p, double r) {
    if ((p - line.points.back()).norm() <= tiny) return;
    line.points.push_back(p);
    line.radius.push_back(r);
  };
  add(cut.point, radius);
  for (std::size_t i = 0; i < points.size(); ++i) add(points[i], radii[i]);
  line.points.back() = points.back();
  for (geometry::TreeNode& node : tree.nodes)
    if (node.id == plane.node) node.position = points.back();
  if (root) {
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.radius.begin(), line.radius.end());
  }
  line.abscissa.clear();
  line.frames.clear();
  geometry::complete(line, first_normal);
  segment.axis = std::move(line);
  return true;
}

}  // namespace ostia::meshing
