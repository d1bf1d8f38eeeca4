#include "ostia/meshing/clip.h"

#include "cutting/end_cut.h"
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
  in(o.move_inside_radii, 0.0, 20.0, "move_inside_radii");
  in(o.reach_radii, 1.0, 100.0, "reach_radii");
  in(o.flat_tolerance, 0.0, 1.0, "flat_tolerance");
  in(o.flat_max_angle_deg, 0.0, 90.0, "flat_max_angle_deg");
  for (const PlacedPlane& plane : o.planes)
    if (!plane.origin.allFinite() || !plane.normal.allFinite() || plane.normal.isZero(0.0))
      throw InvalidInput("clipping: the plane for " + plane.end +
                         " needs an origin and a normal that is not 0");
}

namespace {

struct OpenLoop {
  std::vector<std::int32_t> vertices;
  std::vector<Vec3> points;
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
    loop.points = curve.points;
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

std::string end_words(const EndPlane& plane) {
  return std::string(plane.kind == geometry::FaceKind::inlet ? "the inlet" : "the outlet") + " of vessel " +
         plane.vessel;
}

/// An open end whose rim cannot be closed as it is: it is cut a little inside.
void cut_beside_rim(ClippedSurface& result, std::size_t i, const geometry::VesselTree& tree,
                    double inset_radii) {
  constexpr double beside_radii = 0.3;
  EndPlane& plane = result.ends[i].plane;
  plane.origin = end_planes(tree, std::min(inset_radii, beside_radii))[i].origin;
  result.warnings.push_back(end_words(plane) + ": its rim crosses itself, so it is cut " +
                            core::fixed_text((plane.origin - end_position(tree, plane)).norm(), 2) +
                            " mm farther inside");
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
  Cut cut = placed ? cut_at(result.mesh, wanted, tree, anywhere(options), name)
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

/// An end that cannot be cut where it should be is cut at the nearest place where it can.
bool cut_farther_inside(ClippedSurface& result, const Uncut& uncut, const geometry::VesselTree& tree,
                        const ClipOptions& options) {
  if (!(options.move_inside_radii > 0.0) || placed_plane(options, uncut.plane) != nullptr) return false;
  ClipOptions reaching = options;
  reaching.reach_radii += options.move_inside_radii;
  const auto plane = clean_plane(result.mesh, uncut, tree, reaching, options.move_inside_radii);
  if (!plane) return false;
  const std::string name = end_words(uncut.plane);
  Cut cut = cut_at(result.mesh, *plane, tree, reaching, name);
  result.mesh = std::move(cut.mesh);
  result.ends[uncut.end].plane = std::move(cut.plane);
  result.warnings.push_back(
      uncut.why + "; it was cut " + core::fixed_text((plane->origin - uncut.plane.origin).norm(), 1) +
      " mm farther inside, at " + core::fixed_text(plane->origin.x(), 1) + "," +
      core::fixed_text(plane->origin.y(), 1) + "," + core::fixed_text(plane->origin.z(), 1) + " mm");
  return true;
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
  for (std::size_t i = 0; i < result.ends.size(); ++i) {
    ClippedEnd& end = result.ends[i];
    if (placed_plane(options, end.plane)) continue;
    OpenLoop* loop = flat_end(loops, end.plane, end_position(tree, end.plane), options);
    if (!loop) continue;
    name_inlet(end, *loop, options);
    loop->used = true;
    if (crosses_itself(loop->points)) {
      cut_beside_rim(result, i, tree, options.inset_radii);
      continue;
    }
    end.was_open = true;
    end.plane.origin = loop->centroid;
    end.plane.normal = loop->normal;
    for (const std::int32_t v : loop->vertices) {
      Vec3& p = result.mesh.points[static_cast<std::size_t>(v)];
      p -= (p - loop->centroid).dot(loop->normal) * loop->normal;
    }
  }
  std::vector<Uncut> failed;
  for (std::size_t i = 0; i < result.ends.size(); ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / static_cast<double>(result.ends.size()));
    if (result.ends[i].was_open) continue;
    const EndPlane wanted = result.ends[i].plane;
    try {
      cut_end(result, i, tree, options, end_words(wanted));
    } catch (const GeometryError& error) {
      const Uncut uncut{i, wanted, error.what()};
      if (!cut_farther_inside(result, uncut, tree, options)) failed.push_back(uncut);
    }
  }
  refuse(lumen, failed, tree, options);
  match_loops(result);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
