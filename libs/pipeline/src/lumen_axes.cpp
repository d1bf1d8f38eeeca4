#include "ostia/pipeline/lumen_axes.h"

#include "intake/intake_ends.h"
#include "intake/part_ends.h"

#include "ostia/core/parallel_invoke.h"
#include "ostia/core/text.h"
#include "ostia/geometry/tree_parts.h"

#include <algorithm>
#include <set>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

/// Without what belongs to another surface.
AxesRequest with_what_is_known(AxesRequest request, const TriMesh& lumen) {
  if (request.known && !centerline::is_of(*request.known, lumen)) request.known.reset();
  return request;
}

/// `closed`: blind branches that are left so.
void tell(const PartEnds& ends, const std::vector<PartEnd>& closed, bool chosen,
          std::vector<std::string>& told) {
  const auto branch = [](const PartEnd& end) {
    return "a branch " + core::fixed_text(end.length_mm, 1) + " mm long ends blindly at " +
           place_text(end.point);
  };
  std::size_t found = 0;
  for (const PartEnd& end : ends.targets) {
    found += end.blind && !chosen;
    if (!chosen || end.asked) continue;
    told.push_back(
        (end.blind ? branch(end) : "an open end that no target means is at " + place_text(end.point)) +
        ": it gets an axis and the outlet " + end.name);
  }
  for (const PartEnd& end : closed)
    told.push_back(branch(end) + " and stays closed (--side-branches axes or stubs give it an outlet)");
  if (found > 0)
    told.push_back("closed ends found: " + std::to_string(found) + "; the vessels begin at " +
                   place_text(*ends.source) + " (--source and --target say otherwise)");
}

/// A diameter of the branch beyond the wall of the vessel that it leaves, across its axis.
meshing::PlacedPlane stub_plane(const geometry::VesselTree& tree, const std::string& name) {
  const auto vessel = std::ranges::find(tree.vessels, name, &geometry::Vessel::name);
  const geometry::Centerline& axis = geometry::segment(tree, vessel->segments.back()).axis;
  const double own = axis.radius[axis.size() / 2];
  const double wanted = axis.radius.front() + 2.0 * own;
  std::size_t i = 1;
  double s = 0.0;
  for (; i + 1 < axis.size() && s < wanted; ++i) s += (axis.points[i] - axis.points[i - 1]).norm();
  const std::size_t before = i > 3 ? i - 3 : 0, behind = std::min(axis.size() - 1, i + 3);
  return {"outlet_" + name, axis.points[i], axis.points[behind] - axis.points[before]};
}

/// What questions of inside and outside need is made at the first of them; the axes will ask many.
void make_ready(const centerline::KnownSurface* known) {
  if (known != nullptr && known->tree && !known->closed.points.empty())
    known->tree->inside(known->closed.points.front());
}

core::TaskContext share_of(const core::TaskContext& task, std::size_t i, std::size_t count) {
  const auto part = [&](std::size_t k) { return static_cast<double>(k) / static_cast<double>(count); };
  return task.sub(part(i), part(i + 1));
}

void add(const centerline::CenterlineDiagnostics& one, centerline::CenterlineDiagnostics& all) {
  all.surface_points += one.surface_points;
  all.welded_points += one.welded_points;
  all.dropped_points += one.dropped_points;
  all.delaunay_cells += one.delaunay_cells;
  all.inner_cells += one.inner_cells;
  all.doubtful_cells += one.doubtful_cells;
  all.polygons += one.polygons;
  all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
}

}  // namespace

LumenAxes lumen_axes(const TriMesh& lumen, const AxesRequest& asked_for, const core::TaskContext& task) {
  LumenAxes axes;
  const AxesRequest request = with_what_is_known(asked_for, lumen);
  const std::vector<TriMesh> parts = request.known ? std::vector{lumen} : parts_of(lumen);
  const std::vector<PartRequest> asked = shared_out(parts, request);
  const bool chosen = !request.targets.empty();
  std::size_t number = 0, side = 0;
  std::set<std::string> taken;
  const auto name_of = [&](const PartEnd& end) {
    const std::string base = !end.name.empty()      ? end.name
                             : chosen && !end.asked ? "side_" + std::to_string(++side)
                                                    : "vessel_" + std::to_string(++number);
    std::string name = base;
    for (int k = 2; !taken.insert(name).second; ++k) name = base + "_" + std::to_string(k);
    return name;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const core::TaskContext part_task = share_of(task, i, parts.size());
    PartEnds ends;
    core::parallel_invoke([&] { ends = ends_of_part(parts[i], asked[i], request, part_task); },
                          [&] { make_ready(request.known.get()); });
    centerline::CenterlineOptions options = request.centerline;
    const bool name_them = options.vessel_names.empty();
    std::vector<Vec3> targets;
    std::vector<std::string> stubs;
    for (PartEnd& end : ends.targets) {
      targets.push_back(end.point);
      if (!name_them) continue;
      end.name = name_of(end);
      options.vessel_names.push_back(end.name);
      if (chosen && !end.asked && request.side_branches == SideBranches::stubs) stubs.push_back(end.name);
    }
    std::vector<PartEnd> closed;
    centerline::CenterlineResult found;
    core::parallel_invoke(
        [&] {
          found = centerline::extract_centerlines(parts[i], ends.source, targets, options, part_task,
                                                  request.known.get());
        },
        [&] {
          if (ends.leave_blind) closed = blind_ends(parts[i], asked[i], ends.source, part_task);
        });
    tell(ends, closed, chosen, axes.told);
    axes.told.insert(axes.told.end(), ends.told.begin(), ends.told.end());
    for (const std::string& stub : stubs) axes.stubs.push_back(stub_plane(found.tree, stub));
    geometry::append_tree(axes.tree, std::move(found.tree));
    axes.lines.insert(axes.lines.end(), found.lines.begin(), found.lines.end());
    add(found.diagnostics, axes.diagnostics);
  }
  return axes;
}

std::optional<LumenAxes> with_side_branches(const TriMesh& lumen, const geometry::VesselTree& known,
                                            AxesRequest request, const core::TaskContext& task) {
  if (request.side_branches == SideBranches::asked_only) return std::nullopt;
  request.sources.clear();
  request.targets.clear();
  request.target_names.clear();
  for (const std::int32_t id : geometry::roots(known))
    request.sources.push_back(geometry::node(known, id).position);
  for (const std::int32_t id : geometry::ends(known)) {
    std::string name;
    for (const geometry::Vessel& vessel : known.vessels)
      if (!vessel.segments.empty() && geometry::segment(known, vessel.segments.back()).to == id &&
          name.empty())
        name = vessel.name;
    request.targets.push_back(geometry::node(known, id).position);
    request.target_names.push_back(name);
  }
  request = with_what_is_known(std::move(request), lumen);
  const std::vector<TriMesh> parts = parts_of(lumen);
  const std::vector<PartRequest> asked = shared_out(parts, request);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PartEnds ends = ends_of_part(parts[i], asked[i], request, task);
    if (std::ranges::any_of(ends.targets, [](const PartEnd& end) { return !end.asked; }))
      return lumen_axes(lumen, request, task);
  }
  return std::nullopt;
}

}  // namespace ostia::pipeline
