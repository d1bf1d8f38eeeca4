#include "ostia/meshing/clip.h"

#include "cutting/cut_rim.h"
#include "cutting/plane_cut.h"
#include "cutting/plane_triangulation.h"
#include "remeshing/edit_mesh.h"
#include "remeshing/remesher.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/polyline.h"
#include "ostia/meshing/sizing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const ClipOptions& o) {
  auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("clipping: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.inset_radii, 0.0, 10.0, "inset_radii");
  in(o.sliver_fraction, 0.0, 0.5, "sliver_fraction");
  in(o.reach_radii, 1.0, 100.0, "reach_radii");
  in(o.flat_tolerance, 0.0, 1.0, "flat_tolerance");
  in(o.flat_max_angle_deg, 0.0, 90.0, "flat_max_angle_deg");
  for (const PlacedPlane& plane : o.planes)
    if (!plane.origin.allFinite() || !plane.normal.allFinite() || plane.normal.isZero(0.0))
      throw InvalidInput("clipping: the plane for " + plane.end +
                         " needs an origin and a normal that is not 0");
}

namespace {

/// A cap that meets the wall at less than this makes flat elements.
constexpr double sharp_rim_deg = 40.0;

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

struct OpenLoop {
  std::vector<std::int32_t> vertices;
  Vec3 centroid = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< out of the lumen
  double deviation = 0.0;      ///< of its points from their plane
  bool used = false;
};

std::vector<OpenLoop> open_loops(const geometry::TriMesh& mesh) {
  std::vector<OpenLoop> loops;
  for (const BorderCurve& curve : border_curves(EditMesh(mesh))) {
    OpenLoop loop;
    loop.vertices = curve.vertices;
    for (const Vec3& p : curve.points) loop.centroid += p / static_cast<double>(curve.points.size());
    loop.normal = -loop_normal(curve.points).normalized();
    for (const Vec3& p : curve.points)
      loop.deviation = std::max(loop.deviation, std::abs((p - loop.centroid).dot(loop.normal)));
    loops.push_back(std::move(loop));
  }
  return loops;
}

constexpr double flat_as_it_is = 0.5;  // of an end that is kept whatever its shape

/// The end of the surface that this loop is, where it had a cap.
const GivenEnd* given_at(const ClipOptions& options, const OpenLoop& loop) {
  for (const GivenEnd& end : options.given)
    if ((end.centre - loop.centroid).norm() < 0.5 * end.radius_mm) return &end;
  return nullptr;
}

/// The open and flat loop at an end of the input, if there is one.
OpenLoop* flat_end(std::vector<OpenLoop>& loops, const EndPlane& plane, const Vec3& end,
                   const ClipOptions& options) {
  OpenLoop* best = nullptr;
  double nearest = 3.0 * plane.radius_mm;
  for (OpenLoop& loop : loops) {
    const double distance = (loop.centroid - end).norm();
    if (loop.used || distance >= nearest) continue;
    nearest = distance;
    best = &loop;
  }
  if (!best) return nullptr;
  if ((options.ends_as_they_are || given_at(options, *best)) &&
      best->deviation <= flat_as_it_is * plane.radius_mm)
    return best;
  if (best->deviation > options.flat_tolerance * plane.radius_mm) return nullptr;
  const double cosine = std::cos(options.flat_max_angle_deg * std::numbers::pi / 180.0);
  return best->normal.dot(plane.normal) >= cosine ? best : nullptr;
}

void refuse_inside_out(const geometry::TriMesh& mesh, const geometry::VesselTree& tree) {
  const TubeFunction tube(tree);
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / 500);
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
    const geometry::Triangle& t = mesh.triangles[i];
    const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3 n = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                       .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    sum += n.dot((a - tube(a).axis_point).normalized()) > 0.0 ? 1.0 : -1.0;
  }
  if (sum < 0.0) throw GeometryError("the lumen surface points inward; orient its triangles outward first");
}

/// Finds the loop of each end on the finished surface.
void match_loops(ClippedSurface& result) {
  std::vector<OpenLoop> loops = open_loops(result.mesh);
  for (ClippedEnd& end : result.ends) {
    OpenLoop* best = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (OpenLoop& loop : loops) {
      const double distance = (loop.centroid - end.plane.origin).norm();
      const bool on_plane =
          loop.deviation < 1e-6 && std::abs((loop.centroid - end.plane.origin).dot(end.plane.normal)) < 1e-6;
      if (!loop.used && on_plane && distance < nearest) nearest = distance, best = &loop;
    }
    if (!best)
      throw GeometryError("the end of vessel " + end.plane.vessel +
                          ": no clean border loop came of the cut; change the inset");
    best->used = true;
    end.loop = best->vertices;
  }
  for (const OpenLoop& loop : loops)
    if (!loop.used)
      throw GeometryError(
          "the surface has a hole of " + std::to_string(loop.vertices.size()) + " edges near (" +
          std::to_string(loop.centroid.x()) + ", " + std::to_string(loop.centroid.y()) + ", " +
          std::to_string(loop.centroid.z()) +
          ") mm that belongs to no end of the tree; fill it, or give the tree a branch that ends there");
}

Vec3 end_position(const geometry::VesselTree& tree, const EndPlane& plane) {
  return geometry::node(tree, plane.node).position;
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

namespace {

const PlacedPlane* placed_plane(const ClipOptions& options, const EndPlane& plane) {
  for (const PlacedPlane& placed : options.planes)
    if (placed.end == end_name(plane)) return &placed;
  return nullptr;
}

/// The planes that a person placed, in the places of the program's own.
void take_placed_planes(std::vector<ClippedEnd>& ends, const ClipOptions& options) {
  for (const PlacedPlane& placed : options.planes) {
    for (ClippedEnd& end : ends) {
      if (end_name(end.plane) != placed.end) continue;
      const Vec3 normal = placed.normal.normalized();
      end.plane.origin = placed.origin;
      end.plane.normal = normal.dot(end.plane.normal) < 0.0 ? Vec3(-normal) : normal;
    }
  }
}

/// The surface without one end.
struct Cut {
  geometry::TriMesh mesh;
  EndPlane plane;
  RimWedge rim;
};
Cut cut_at(const geometry::TriMesh& surface, EndPlane plane, const geometry::VesselTree& tree,
           const ClipOptions& options, const std::string& name) {
  Cut cut;
  cut.mesh = cut_branch(surface, plane, end_position(tree, plane), options, name);
  cut.plane = std::move(plane);
  cut.rim = sharpest_rim(cut.mesh, cut.plane);
  return cut;
}

/// Where a plane does not cut cleanly (an end torn aslant, say), or runs along a wall that flares (into the
/// aorta, say), it is tried up to one radius farther inside; the cut whose wedge is the least sharp is taken.
Cut best_cut(const geometry::TriMesh& surface, std::size_t i, const EndPlane& wanted,
             const geometry::VesselTree& tree, const ClipOptions& options, const std::string& name) {
  std::optional<Cut> best;
  std::optional<GeometryError> at_first;
  for (const double extra : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const EndPlane plane = extra > 0.0 ? end_planes(tree, options.inset_radii + extra)[i] : wanted;
    try {
      Cut cut = cut_at(surface, plane, tree, options, name);
      if (!best || cut.rim.angle_deg > best->rim.angle_deg) best = std::move(cut);
      if (best->rim.angle_deg >= sharp_rim_deg) break;
    } catch (const GeometryError& error) {
      if (!at_first) at_first = error;
    }
  }
  if (!best) throw GeometryError(*at_first);
  return std::move(*best);
}

std::string end_words(const EndPlane& plane) {
  return std::string(plane.kind == geometry::FaceKind::inlet ? "the inlet" : "the outlet") + " of vessel " +
         plane.vessel;
}

/// All ends that cannot be cut at once, each with its place and what a person can do.
void refuse(const std::vector<std::pair<EndPlane, std::string>>& failed) {
  if (failed.empty()) return;
  std::string message = failed.size() == 1 ? "" : std::to_string(failed.size()) + " ends cannot be cut:\n";
  for (const auto& [plane, why] : failed) {
    if (failed.size() > 1) message += "  ";
    message += why + "; cut it where its lumen is a clean tube by --plane " + end_name(plane) + "=";
    const Vec3 inside = plane.origin - 2.0 * plane.radius_mm * plane.normal;
    for (int k = 0; k < 3; ++k) message += (k ? "," : "") + core::fixed_text(inside[k], 2);
    for (int k = 0; k < 3; ++k) message += (k ? "," : ":") + core::fixed_text(plane.normal[k], 3);
    message += " (now at " + core::fixed_text(plane.origin.x(), 2) + "," +
               core::fixed_text(plane.origin.y(), 2) + "," + core::fixed_text(plane.origin.z(), 2) +
               "), or farther inside by --inset";
    if (failed.size() > 1) message += "\n";
  }
  throw GeometryError(message);
}

/// The inlet is called as its cap was; outlets have the names of their vessels already.
void name_inlet(ClippedEnd& end, const OpenLoop& loop, const ClipOptions& options) {
  const GivenEnd* given = given_at(options, loop);
  if (given && !given->name.empty() && end.plane.kind == geometry::FaceKind::inlet)
    end.plane.vessel = given->name;
}

void cut_end(ClippedSurface& result, std::size_t i, const geometry::VesselTree& tree,
             const ClipOptions& options, const std::string& name) {
  ClippedEnd& end = result.ends[i];
  const EndPlane wanted = end.plane;
  const bool placed = placed_plane(options, end.plane) != nullptr;
  ClipOptions anywhere = options;  // a person may cut at any distance from the axis' end
  anywhere.reach_radii = std::numeric_limits<double>::infinity();
  Cut cut = placed ? cut_at(result.mesh, wanted, tree, anywhere, name)
                   : best_cut(result.mesh, i, wanted, tree, options, name);
  result.mesh = std::move(cut.mesh);
  end.plane = std::move(cut.plane);
  const double moved = (end.plane.origin - wanted.origin).norm();
  if (!placed && moved > 2e-3 * wanted.radius_mm)
    result.warnings.push_back(name + ": the plane was moved inside by " + std::to_string(moved) +
                              " mm to cut cleanly");
  if (cut.rim.angle_deg >= sharp_rim_deg) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "%s: the plane meets the wall at %.2g degrees near (%.2f, %.2f, %.2f) mm, and elements there "
                "get as flat; place it farther inside",
                name.c_str(), cut.rim.angle_deg, cut.rim.at.x(), cut.rim.at.y(), cut.rim.at.z());
  result.warnings.emplace_back(text);
}

}  // namespace

ClippedSurface clip_ends(const geometry::TriMesh& lumen, const geometry::VesselTree& tree,
                         const ClipOptions& given, const core::TaskContext& task) {
  validate(given);
  if (lumen.triangles.empty()) throw InvalidInput("clipping: the surface has no triangles");
  task.set_stage("clipping");
  ClippedSurface result;
  const std::vector<EndPlane> planes = end_planes(tree, given.inset_radii);
  for (const EndPlane& plane : planes) result.ends.push_back({plane, {}, false});
  if (result.ends.empty()) throw InvalidInput("clipping: the tree has no root and no end");
  ClipOptions options = given;
  options.planes = with_ends(given.planes, planes);
  take_placed_planes(result.ends, options);
  refuse_inside_out(lumen, tree);
  result.mesh = lumen;
  // Ends that are open already keep their loops, made exactly flat; the search is on the input, before any
  // cut.
  std::vector<OpenLoop> loops = open_loops(lumen);
  for (ClippedEnd& end : result.ends) {
    if (placed_plane(options, end.plane)) continue;
    OpenLoop* loop = flat_end(loops, end.plane, end_position(tree, end.plane), options);
    if (!loop) continue;
    loop->used = end.was_open = true;
    name_inlet(end, *loop, options);
    end.plane.origin = loop->centroid;
    end.plane.normal = loop->normal;
    for (const std::int32_t v : loop->vertices) {
      Vec3& p = result.mesh.points[static_cast<std::size_t>(v)];
      p -= (p - loop->centroid).dot(loop->normal) * loop->normal;
    }
  }
  std::vector<std::pair<EndPlane, std::string>> failed;
  for (std::size_t i = 0; i < result.ends.size(); ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / static_cast<double>(result.ends.size()));
    if (result.ends[i].was_open) continue;
    const EndPlane wanted = result.ends[i].plane;
    try {
      cut_end(result, i, tree, options, end_words(wanted));
    } catch (const GeometryError& error) {
      failed.emplace_back(wanted, error.what());
    }
  }
  refuse(failed);
  match_loops(result);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
