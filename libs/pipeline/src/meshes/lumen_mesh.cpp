// From a lumen and its axes to a mesh that has passed the gate.

#include "mask/lumen_fill.h"
#include "meshes/lumen_remeshing.h"
#include "stages.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/tree_parts.h"
#include "ostia/meshing/caps.h"
#include "ostia/pipeline/model.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

geometry::Vec3 centre_of(const TriMesh& mesh, const std::vector<std::int32_t>& loop) {
  geometry::Vec3 sum = geometry::Vec3::Zero();
  for (const std::int32_t p : loop) sum += mesh.points[static_cast<std::size_t>(p)];
  return sum / static_cast<double>(loop.size());
}

/// The part of the surface on which each end's loop lies.
std::vector<std::int32_t> parts_of_ends(const meshing::ClippedSurface& clipped) {
  const std::vector<std::int32_t> part = geometry::components(clipped.mesh);
  std::vector<std::int32_t> of_point(clipped.mesh.points.size(), -1);
  for (std::size_t t = 0; t < part.size(); ++t)
    for (const std::int32_t p : clipped.mesh.triangles[t]) of_point[static_cast<std::size_t>(p)] = part[t];
  std::vector<std::int32_t> parts;
  for (const meshing::ClippedEnd& end : clipped.ends)
    parts.push_back(of_point[static_cast<std::size_t>(end.loop.front())]);
  return parts;
}

/// From the cut inlet's centre to the cut outlets' centres, part by part; vessels keep their names.
centerline::CenterlineResult centerlines_between(const meshing::ClippedSurface& clipped,
                                                 const geometry::VesselTree& tree,
                                                 centerline::CenterlineOptions options,
                                                 const core::TaskContext& task) {
  const std::vector<std::int32_t> part_of = parts_of_ends(clipped);
  const std::vector<TriMesh> parts = parts_of(clipped.mesh);
  centerline::CenterlineResult all;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::optional<geometry::Vec3> source;
    std::vector<geometry::Vec3> targets;
    options.vessel_names.clear();
    const auto ends_here = [&](geometry::FaceKind kind, const std::string* vessel, const auto& use) {
      for (std::size_t i = 0; i < clipped.ends.size(); ++i) {
        const meshing::ClippedEnd& end = clipped.ends[i];
        if (part_of[i] == static_cast<std::int32_t>(k) && end.plane.kind == kind &&
            (!vessel || end.plane.vessel == *vessel))
          use(centre_of(clipped.mesh, end.loop));
      }
    };
    ends_here(geometry::FaceKind::inlet, nullptr, [&](const geometry::Vec3& centre) {
      if (source)
        throw InvalidInput("the centerlines have several roots in one lumen; a lumen has one inlet");
      source = centre;
    });
    for (const geometry::Vessel& vessel : tree.vessels)
      ends_here(geometry::FaceKind::outlet, &vessel.name, [&](const geometry::Vec3& centre) {
        targets.push_back(centre);
        options.vessel_names.push_back(vessel.name);
      });
    centerline::CenterlineResult one = centerline::extract_centerlines(
        parts[k], source, targets, options,
        task.sub(static_cast<double>(k) / static_cast<double>(parts.size()),
                 static_cast<double>(k + 1) / static_cast<double>(parts.size())));
    if (k == 0) {
      all = std::move(one);
      continue;
    }
    geometry::append_tree(all.tree, std::move(one.tree));
    all.lines.insert(all.lines.end(), one.lines.begin(), one.lines.end());
    all.ends.insert(all.ends.end(), one.ends.begin(), one.ends.end());
    all.end_radii.insert(all.end_radii.end(), one.end_radii.begin(), one.end_radii.end());
    append(all.diagnostics.warnings, one.diagnostics.warnings);
  }
  return all;
}

constexpr Shares with_extraction{0.04, 0.2, 0.22, 0.5, 0.9};
constexpr Shares with_known_axes{0.2, 0.2, 0.21, 0.62, 0.97};

using AxesOf =
    std::function<centerline::CenterlineResult(const meshing::ClippedSurface&, const core::TaskContext&)>;

double middle_of_caps(const Shares& shares) {
  return 0.5 * (shares.axes + shares.caps);
}

std::vector<std::string> names_of(const std::vector<meshing::ClippedEnd>& ends) {
  std::vector<std::string> names;
  for (const meshing::ClippedEnd& end : ends) names.push_back(meshing::end_name(end.plane));
  return names;
}

/// Ends that are kept as they came are not cut, and so not inset: said where an inset was asked for.
void tell_not_inset(const std::vector<meshing::ClippedEnd>& ends, std::vector<std::string>& told) {
  std::string names;
  std::size_t count = 0;
  for (const meshing::ClippedEnd& end : ends)
    if (end.was_open) names += (count++ > 0 ? ", " : "") + meshing::end_name(end.plane);
  if (count > 0)
    told.push_back("the inset (--inset) does nothing at " + std::to_string(count) + " of " +
                   std::to_string(ends.size()) + " ends, which are open or capped and stay where they are: " +
                   names + "; --plane END=x,y,z:nx,ny,nz cuts one farther inside");
}

/// The cut lumen and its axes led on beyond its ends.
Extended extend(const meshing::FlowExtensionOptions& options, const Shares& shares, Stages& stages,
                meshing::ClippedSurface& clipped, geometry::VesselTree& axes, MeshedLumen& out) {
  meshing::ExtendedEnds extended = stages.run(
      "flow extensions", shares.axes, middle_of_caps(shares),
      [&](const core::TaskContext& part) { return meshing::extend_ends(clipped, axes, options, part); });
  Extended both{std::exchange(clipped, std::move(extended.surface)), {}};
  both.after = clipped.mesh;
  axes = std::move(extended.tree);
  append(out.warnings, extended.warnings);
  out.quality.extensions = std::move(extended.extensions);
  return both;
}

/// Remeshed and filled. Sizes follow `axes`.
void mesh_capped(const geometry::FacedSurface& capped, const std::optional<Extended>& extended,
                 const geometry::VesselTree& axes, const ModelOptions& options, const Shares& shares,
                 Stages& stages, MeshedLumen& out) {
  const meshing::TubeFunction tube(axes);
  meshing::RemeshedSurface remeshed =
      stages.run("remeshing", shares.caps, shares.remeshing, [&](const core::TaskContext& part) {
        return remeshed_lumen(capped, tube, axes, options, out.warnings, part);
      });
  append(out.warnings, remeshed.report.warnings);
  out.surface = std::move(remeshed.surface);
  out.remeshing = remeshed.report;
  fill_and_judge(capped, extended, tube, options, shares, stages, out);
}

MeshedLumen mesh_with(const TriMesh& lumen, const geometry::VesselTree& tree, const ModelOptions& options,
                      const Shares& shares, const AxesOf& axes_of, const core::TaskContext& task) {
  validate(options);
  MeshedLumen out;
  Stages stages(out.stages, task);
  meshing::ClippedSurface clipped =
      stages.run("ends cut", 0.0, shares.cut, [&](const core::TaskContext& part) {
        meshing::ClipOptions clip = options.clip;
        if (options.inset_radii) clip.inset_radii = *options.inset_radii;
        return meshing::clip_ends(lumen, tree, clip, part);
      });
  append(out.warnings, clipped.warnings);
  if (options.inset_radii) tell_not_inset(clipped.ends, out.warnings);
  if (options.volume.solver_case) require_inlets(*options.volume.solver_case, names_of(clipped.ends));
  out.centerlines = stages.run("centerlines of the cut lumen", shares.cut, shares.axes,
                               [&](const core::TaskContext& part) { return axes_of(clipped, part); });
  geometry::VesselTree axes = out.centerlines.tree;
  std::optional<Extended> extended;
  if (options.extensions) extended = extend(*options.extensions, shares, stages, clipped, axes, out);
  const geometry::FacedSurface capped =
      stages.run("caps", options.extensions ? middle_of_caps(shares) : shares.axes, shares.caps,
                 [&](const core::TaskContext& part) { return meshing::cap_ends(clipped, {}, part); });
  mesh_capped(capped, extended, axes, options, shares, stages, out);
  return out;
}

}  // namespace

MeshedLumen mesh_lumen(const TriMesh& lumen, const geometry::VesselTree& tree, const ModelOptions& options,
                       const core::TaskContext& task) {
  const auto extracted = [&](const meshing::ClippedSurface& clipped, const core::TaskContext& part) {
    return centerlines_between(clipped, tree, options.centerline, part);
  };
  return mesh_with(lumen, tree, options, with_extraction, extracted, task);
}

MeshedLumen mesh_lumen_about(const TriMesh& lumen, const geometry::VesselTree& axes,
                             const ModelOptions& options, const core::TaskContext& task) {
  const auto known = [&](const meshing::ClippedSurface&, const core::TaskContext&) {
    centerline::CenterlineResult result;
    result.tree = axes;
    return result;
  };
  return mesh_with(lumen, axes, options, with_known_axes, known, task);
}

}  // namespace ostia::pipeline
