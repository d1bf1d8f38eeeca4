#include "ostia/meshing/flow_extension.h"

#include "cutting/plane_triangulation.h"
#include "cutting/seam.h"
#include "flow_extension/axes.h"
#include "flow_extension/extension.h"
#include "remeshing/edit_mesh.h"

#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const FlowExtensionOptions& o) {
  auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("flow extensions: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.inlet_diameters, 0.25, 100.0, "inlet_diameters");
  in(o.outlet_diameters, 0.25, 100.0, "outlet_diameters");
  in(o.transition_share, 0.01, 1.0, "transition_share");
  in(o.bend_deg, 0.0, 180.0, "bend_deg");
  in(o.min_diameters, 0.25, 100.0, "min_diameters");
  in(o.clearance, 0.0, 1.0, "clearance");
  if (!o.bend_towards.allFinite()) throw InvalidInput("flow extensions: bend_towards is not finite");
  for (const auto& [end, points] : o.axes)
    if (points.empty() ||
        !std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); }))
      throw InvalidInput("flow extensions: the axis given for " + end + " needs points, all of them finite");
}

namespace {

constexpr double most_oblique_deg = 60.0;  // between the axis and the section's normal
constexpr double least_transition = 3.0;   // times the reach of an oblique section along the axis
constexpr double good_seam_deg = 25.0;

void check_loops(const ClippedSurface& clipped) {
  if (clipped.ends.empty())
    throw InvalidInput("flow extensions: the surface has no clipped ends; clip_ends makes them");
  const EditMesh mesh(clipped.mesh);
  for (const ClippedEnd& end : clipped.ends) {
    const auto wrong = [&](const std::string& what) {
      throw InvalidInput("flow extensions: " + end_name(end.plane) + " " + what + "; clip the ends first");
    };
    if (end.loop.size() < 3) wrong("has no border loop");
    for (std::size_t i = 0; i < end.loop.size(); ++i) {
      const std::int32_t v = end.loop[i];
      if (v < 0 || v >= mesh.vertex_count() || !mesh.alive_vertex(v))
        wrong("names points that the surface has not");
      if (!mesh.border(v) || mesh.target(mesh.out(v)) != end.loop[(i + 1) % end.loop.size()])
        wrong("has a loop that is no border of the surface");
    }
  }
}

/// Which ends are extended.
std::vector<std::size_t> chosen(const ClippedSurface& clipped, const FlowExtensionOptions& options) {
  std::vector<std::size_t> ends;
  std::string all;
  for (std::size_t i = 0; i < clipped.ends.size(); ++i) {
    const EndPlane& plane = clipped.ends[i].plane;
    all += (i == 0 ? "" : ", ") + end_name(plane);
    const bool named = std::any_of(options.ends.begin(), options.ends.end(), [&](const std::string& name) {
      return name == plane.vessel || name == end_name(plane);
    });
    if (options.ends.empty() || named) ends.push_back(i);
  }
  const auto known = [&](const std::string& name, bool with_vessels) {
    return std::any_of(clipped.ends.begin(), clipped.ends.end(), [&](const ClippedEnd& end) {
      return name == end_name(end.plane) || (with_vessels && name == end.plane.vessel);
    });
  };
  const auto refuse = [&](const std::string& name) {
    throw InvalidInput("flow extensions: there is no end " + name + "; the ends are " + all);
  };
  for (const std::string& name : options.ends)
    if (!known(name, true)) refuse(name);
  for (const auto& [name, points] : options.axes)
    if (!known(name, false)) refuse(name);
  return ends;
}

/// Evens the seam of an end; all loops get the new numbers.
void even(ClippedSurface& clipped, std::size_t end) {
  auto seam = even_seam(clipped.mesh, clipped.ends[end].loop);
  if (!seam) return;
  clipped.mesh = std::move(seam->mesh);
  for (std::size_t i = 0; i < clipped.ends.size(); ++i)
    for (std::int32_t& v : clipped.ends[i].loop) v = i == end ? v : seam->number[static_cast<std::size_t>(v)];
  clipped.ends[end].loop = std::move(seam->loop);
}

void set_bend(Extension& e, const FlowExtensionOptions& options, const AxisEnd& axis) {
  const auto given = options.axes.find(e.section.name);
  if (given != options.axes.end()) e.through = given->second;
  e.bend_deg = e.through.empty() ? options.bend_deg : 0.0;
  const Vec3& d = e.section.frame.tangent;
  Vec3 side = options.bend_towards;
  if (side.isZero(0.0)) side = axis.turning;
  side -= side.dot(d) * d;
  if (options.bend_deg > 0.0 && !options.bend_towards.isZero(0.0) &&
      side.norm() < 1e-3 * options.bend_towards.norm())
    throw InvalidInput("flow extensions: bend_towards lies along the axis of " + e.section.name);
  e.side = side.norm() > 1e-9 ? side.normalized() : e.section.frame.normal;
}

/// Everything that is known of an extension before it is built. `area`: of the section as it was given.
Extension planned(const ClippedSurface& clipped, std::size_t end, double area,
                  const geometry::VesselTree& tree, const FlowExtensionOptions& options) {
  const EndPlane& plane = clipped.ends[end].plane;
  const std::string name = end_name(plane);
  std::vector<Vec3> loop = loop_points(clipped.mesh, clipped.ends[end].loop);
  std::reverse(loop.begin(), loop.end());
  const Vec3 normal = loop_normal(loop).normalized();
  const AxisEnd axis = axis_end(tree, plane, 2.0 * std::sqrt(area / std::numbers::pi));
  const Vec3 direction = options.direction == ExtensionDirection::section ? normal : axis.direction;
  const double cosine = direction.dot(normal);
  if (!(cosine > std::cos(most_oblique_deg * std::numbers::pi / 180.0)))
    throw GeometryError("flow extensions: the section of " + name + " stands " +
                        std::to_string(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi) +
                        " degrees off the axis; cut the end across its axis, or let the extension follow the "
                        "section's normal");
  Extension e;
  e.end = end;
  e.section = section_of(name, loop, direction, options.area_across_axis ? area * cosine : area);
  set_bend(e, options, axis);
  const double diameter = 2.0 * e.section.radius;
  const bool inlet = plane.kind == geometry::FaceKind::inlet;
  e.wanted = diameter * (inlet ? options.inlet_diameters : options.outlet_diameters);
  if (!e.through.empty()) e.wanted = axis_of(e).length();
  const double reach = std::max(e.section.ahead, e.section.behind);
  const double fold_free = least_transition * reach;
  if (e.wanted < std::max(fold_free, 1.2 * e.section.ahead))
    throw GeometryError("flow extensions: " + name + " is cut obliquely; an extension of " +
                        std::to_string(e.wanted) + " mm would fold there, " + std::to_string(fold_free) +
                        " mm or more is needed");
  e.length = e.wanted;
  e.shortest = std::min(e.wanted, std::max(options.min_diameters * diameter, fold_free));
  e.transition = std::clamp(options.transition_share * e.wanted, fold_free, e.wanted);
  axis_of(e);  // refuses a bend that is too tight
  return e;
}

FlowExtension report_of(const Extension& e, double area) {
  FlowExtension out;
  out.end = e.section.name;
  out.direction = e.section.frame.tangent;
  out.diameter_mm = 2.0 * e.section.radius;
  out.length_mm = e.length;
  out.wanted_length_mm = e.wanted;
  out.transition_mm = std::min(e.transition, e.length);
  out.bend_deg = e.bend_deg * e.length / e.wanted;
  out.section_area_mm2 = area;
  out.end_area_mm2 = polygon_area(e.rings.rings.back());
  return out;
}

/// The axis of the lumen goes over into that of the extension within the transition.
void lead_axis_on(ExtendedEnds& out, const EndPlane& plane, const Extension& e) {
  const AxisPoint start = axis_at_section(out.tree, plane);
  const ExtensionAxis axis = axis_of(e);
  const Vec3& d = e.section.frame.tangent;
  const double ahead = (start.point - e.section.centre).dot(d);
  const Vec3 aside = start.point - e.section.centre - ahead * d;
  const double blend = std::min(e.transition, e.length);
  std::vector<Vec3> points;
  std::vector<double> radii;
  const int steps = std::max(8, static_cast<int>(std::ceil(e.length / (0.5 * e.section.radius))));
  for (int i = 1; i <= steps; ++i) {
    const double s = e.length * i / steps;
    if (s < ahead + 0.25 * e.length / steps) continue;
    const double t = std::min(1.0, s / blend), left = i == steps ? 0.0 : 1.0 - t * t * (3.0 - 2.0 * t);
    points.push_back(axis.point(s) + left * aside);
    radii.push_back(e.section.radius + left * (start.radius - e.section.radius));
  }
  if (!extend_axis(out.tree, plane, points, radii))
    out.warnings.push_back(e.section.name +
                           ": several axes begin there, and none of them is led on into the extension");
}

/// Mends seams that have come out with small angles; `seams` and all loops get the new numbers.
void mend_seams(ClippedSurface& surface, std::vector<std::vector<std::int32_t>>& seams) {
  constexpr double mended_below_deg = 30.0;
  for (std::size_t i = 0; i < seams.size(); ++i) {
    if (seam_angle_deg(surface.mesh, seams[i]) >= mended_below_deg) continue;
    auto mended = mended_seam(surface.mesh, seams[i]);
    if (!mended) continue;
    surface.mesh = std::move(mended->mesh);
    const auto renumber = [&](std::vector<std::int32_t>& loop) {
      for (std::int32_t& v : loop) v = mended->number[static_cast<std::size_t>(v)];
      std::erase(loop, EditMesh::none);
    };
    for (ClippedEnd& end : surface.ends) renumber(end.loop);
    for (auto& seam : seams) renumber(seam);
  }
}

/// The surface, its far ends as its ends, and the axes.
void finish(ExtendedEnds& out, const ClippedSurface& even_ends, const std::vector<Extension>& extensions,
            const std::vector<double>& areas, bool mend) {
  std::vector<std::vector<std::int32_t>> seams;
  for (const Extension& e : extensions) seams.push_back(even_ends.ends[e.end].loop);
  Joined all = joined(even_ends.mesh, seams, extensions);
  out.surface = even_ends;
  out.surface.mesh = std::move(all.mesh);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    const Extension& e = extensions[i];
    ClippedEnd& end = out.surface.ends[e.end];
    lead_axis_on(out, end.plane, e);
    const ExtensionAxis axis = axis_of(e);
    end.plane.origin = axis.point(e.length);
    end.plane.normal = axis.frame(e.length).tangent;
    end.plane.radius_mm = e.section.radius;
    end.loop = all.far_loops[i];
    end.was_open = false;
  }
  if (mend) mend_seams(out.surface, seams);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    FlowExtension made = report_of(extensions[i], areas[i]);
    made.seam_angle_deg = seam_angle_deg(out.surface.mesh, seams[i]);
    if (made.seam_angle_deg < good_seam_deg)
      out.warnings.push_back(made.end + ": triangles at the seam have an angle of " +
                             std::to_string(made.seam_angle_deg) + " degrees; remesh the surface");
    out.extensions.push_back(std::move(made));
  }
}

/// What of the whole still intersects: the lumen's own faults are told, others are this part's.
void judge(ExtendedEnds& out, const geometry::TriMesh& lumen) {
  const std::size_t now = geometry::self_intersections(out.surface.mesh).size();
  if (now == 0) return;
  if (now > geometry::self_intersections(lumen).size())
    throw GeometryError(
        "flow extensions: an extension meets the wall where it begins; cut the end elsewhere");
  out.warnings.push_back("the lumen intersects itself in " + std::to_string(now) +
                         " pairs of triangles; repair it");
}

}  // namespace

ExtendedEnds extend_ends(const ClippedSurface& clipped, const geometry::VesselTree& tree,
                         const FlowExtensionOptions& options, const core::TaskContext& task) {
  validate(options);
  if (const auto fault = geometry::find_fault(tree))
    throw InvalidInput("flow extensions: the tree is not sound: " + *fault);
  check_loops(clipped);
  task.set_stage("flow extensions");
  const std::vector<std::size_t> ends = chosen(clipped, options);
  ClippedSurface even_ends = clipped;
  std::vector<double> areas;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    task.throw_if_cancelled();
    task.set_progress(0.3 * static_cast<double>(i) / static_cast<double>(ends.size()));
    areas.push_back(polygon_area(loop_points(clipped.mesh, clipped.ends[ends[i]].loop)));
    if (options.even_seam) even(even_ends, ends[i]);
  }
  for (ClippedEnd& end : even_ends.ends) end.plane = at_node_of(tree, end.plane);
  std::vector<Extension> extensions;
  std::vector<std::vector<std::int32_t>> loops, open_loops;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    extensions.push_back(planned(even_ends, ends[i], areas[i], tree, options));
    loops.push_back(even_ends.ends[ends[i]].loop);
  }
  const std::set<std::size_t> extended(ends.begin(), ends.end());
  for (std::size_t i = 0; i < even_ends.ends.size(); ++i)
    if (!extended.contains(i)) open_loops.push_back(even_ends.ends[i].loop);
  ExtendedEnds out;
  out.tree = tree;
  keep_apart(even_ends.mesh, loops, open_loops, extensions, options, out.warnings, task.sub(0.3, 0.9));
  finish(out, even_ends, extensions, areas, options.even_seam);
  judge(out, even_ends.mesh);
  out.surface.warnings = clipped.warnings;
  out.surface.warnings.insert(out.surface.warnings.end(), out.warnings.begin(), out.warnings.end());
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::meshing
