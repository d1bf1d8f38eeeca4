#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/meshing/clip.h"

#include <algorithm>
#include <set>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// The vessel whose path begins (root) or ends here, fit for a file name.
std::string vessel_name(const geometry::VesselTree& tree, std::int32_t segment, bool root,
                        std::size_t number) {
  std::string name;
  for (const geometry::Vessel& vessel : tree.vessels)
    if (name.empty() && !vessel.segments.empty() &&
        (root ? vessel.segments.front() : vessel.segments.back()) == segment)
      name = vessel.name;
  if (name.empty()) name = std::to_string(number);
  for (char& c : name)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-')) c = '_';
  return name;
}

/// The plane at the end of an axis that runs inward from it.
EndPlane plane_on(const std::vector<Vec3>& points, const std::vector<double>& radius, double inset_radii) {
  const std::vector<double> at = geometry::abscissas(points);
  const double length = at.back();
  auto radius_at = [&](double s) {
    const auto place = geometry::at_abscissa(points, s);
    return (1.0 - place.t) * radius[place.segment] + place.t * radius[place.segment + 1];
  };
  // The inscribed radius falls to nothing in a rounded end; the vessel's own is the largest just inside it.
  double own = 0.0;
  const double window = std::min(length, 2.0 * radius_at(0.5 * length));
  for (int i = 0; i <= 32; ++i) own = std::max(own, radius_at(window * i / 32.0));
  const double s = std::min(inset_radii * own, 0.5 * length);
  EndPlane plane;
  plane.origin = geometry::at_abscissa(points, s).point;
  plane.radius_mm = own;
  // The mean direction over a diameter, which a kink of the axis does not turn.
  const Vec3 outer = geometry::at_abscissa(points, std::max(0.0, s - own)).point;
  const Vec3 inner = geometry::at_abscissa(points, std::min(length, s + own)).point;
  plane.normal = (outer - inner).normalized();
  return plane;
}

}  // namespace

std::string end_name(const EndPlane& plane) {
  return (plane.kind == geometry::FaceKind::inlet ? "inlet_" : "outlet_") + plane.vessel;
}

std::vector<EndPlane> end_planes(const geometry::VesselTree& tree, double inset_radii) {
  if (const auto fault = geometry::find_fault(tree))
    throw InvalidInput("clipping: the tree is not sound: " + *fault);
  std::vector<EndPlane> planes;
  auto add = [&](std::int32_t node, bool root) {
    for (const geometry::TreeSegment& segment : tree.segments) {
      if ((root ? segment.from : segment.to) != node) continue;
      if (segment.axis.size() < 2 || segment.axis.radius.size() != segment.axis.size())
        throw InvalidInput("clipping: segment " + std::to_string(segment.id) +
                           " needs two points and a radius at each");
      std::vector<Vec3> points = segment.axis.points;
      std::vector<double> radius = segment.axis.radius;
      if (!root) {
        std::reverse(points.begin(), points.end());
        std::reverse(radius.begin(), radius.end());
      }
      EndPlane plane = plane_on(points, radius, inset_radii);
      plane.node = node;
      plane.kind = root ? geometry::FaceKind::inlet : geometry::FaceKind::outlet;
      plane.vessel = vessel_name(tree, segment.id, root, planes.size() + 1);
      const std::string base = plane.vessel;
      auto taken = [&] {
        return std::any_of(planes.begin(), planes.end(), [&](const EndPlane& p) {
          return p.kind == plane.kind && p.vessel == plane.vessel;
        });
      };
      for (int k = 2; taken(); ++k) plane.vessel = base + "_" + std::to_string(k);
      planes.push_back(plane);
      return;
    }
  };
  for (const std::int32_t id : geometry::roots(tree)) add(id, true);
  for (const std::int32_t id : geometry::ends(tree)) add(id, false);
  return planes;
}

std::vector<PlacedPlane> with_ends(std::vector<PlacedPlane> planes, const std::vector<EndPlane>& ends) {
  std::set<std::string> taken;
  for (PlacedPlane& placed : planes) {
    if (placed.end.empty() && !ends.empty())
      placed.end = end_name(*std::ranges::min_element(
          ends, {}, [&](const EndPlane& end) { return (end.origin - placed.origin).squaredNorm(); }));
    std::string all;
    for (const EndPlane& end : ends) all += (all.empty() ? "" : ", ") + end_name(end);
    if (std::ranges::find(ends, placed.end, end_name) == ends.end())
      throw InvalidInput("clipping: a plane is given for " + placed.end + ", but the ends are " + all);
    if (!taken.insert(placed.end).second)
      throw InvalidInput("clipping: two planes are given for " + placed.end + "; the ends are " + all);
  }
  return planes;
}

}  // namespace ostia::meshing
