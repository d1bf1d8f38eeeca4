#include "ostia/pipeline/lumen_axes.h"

#include "ostia/centerline/end_points.h"
#include "ostia/centerline/surface_tips.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel_invoke.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <limits>
#include <set>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

// A point within this many radii of an end means it.
constexpr double means_end_radii = 2.0;
// A target lies on the branch whose way along the wall passes it within this many of the branch's radii.
constexpr double on_branch_radii = 2.5;
// Of a closed tree a short trunk is an end, too, where it is so many radii long, wider than all longer
// branches and no ball on a neck.
constexpr double least_stub_radii = 2.0, short_trunk_radii = 3.0, wider_than_branches = 1.1, least_neck = 0.8;

/// Where a vessel may end.
struct End {
  Vec3 point = Vec3::Zero();
  double radius_mm = 0.0;
  std::string name;
  std::optional<geometry::FaceKind> kind;
  bool asked = false;      ///< a target of the user's
  bool blind = false;      ///< closed: a tip
  double length_mm = 0.0;  ///< of a tip's branch
};

std::string in_words(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " +
         core::fixed_text(p.z(), 1) + ") mm";
}

std::vector<Vec3> holes_in_wall(const TriMesh& part, const std::vector<std::vector<std::int32_t>>& loops) {
  const geometry::AabbTree closed(geometry::fill_holes(part).mesh);
  std::vector<Vec3> holes;
  for (const auto& loop : loops)
    if (const meshing::GivenEnd end = meshing::end_at_loop(part, loop); meshing::is_hole_in_wall(closed, end))
      holes.push_back(end.centre);
  return holes;
}

/// Openings that are no holes in the wall, longest border first.
std::vector<End> open_ends(const TriMesh& part, const std::vector<meshing::GivenEnd>& given,
                           const centerline::KnownSurface* known) {
  std::vector<End> ends;
  const auto loops = known != nullptr ? known->loops : geometry::boundary_loops(part);
  if (loops.empty()) return ends;
  const std::vector<Vec3> holes = known != nullptr ? std::vector<Vec3>{} : holes_in_wall(part, loops);
  for (const centerline::Opening& opening : centerline::find_openings(part, loops)) {
    if (std::ranges::any_of(holes, [&](const Vec3& hole) { return (hole - opening.centre).norm() < 1e-9; }))
      continue;
    End end{opening.centre, opening.radius, "", {}, false, false, 0.0};
    for (const meshing::GivenEnd& one : given) {
      if ((one.centre - opening.centre).norm() > 0.5 * one.radius_mm) continue;
      end.name = one.name;
      end.kind = one.kind;
    }
    ends.push_back(end);
  }
  return ends;
}

double distance_to(const Vec3& point, const std::vector<Vec3>& way) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : way) least = std::min(least, (p - point).norm());
  return least;
}

/// The nearest open end, where the point is near enough to mean it.
std::optional<std::size_t> end_meant_by(const Vec3& point, const std::vector<End>& ends) {
  std::optional<std::size_t> best;
  const auto distance = [&](std::size_t i) { return (point - ends[i].point).norm(); };
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (distance(i) <= means_end_radii * ends[i].radius_mm && (!best || distance(i) < distance(*best)))
      best = i;
  return best;
}

/// Without what belongs to another surface.
AxesRequest with_what_is_known(AxesRequest request, const TriMesh& lumen) {
  if (request.known && !centerline::is_of(*request.known, lumen)) request.known.reset();
  return request;
}

/// What one part is asked for.
struct PartRequest {
  std::optional<Vec3> source;
  std::vector<Vec3> targets;
  std::vector<std::string> names;  ///< as many, or none
};

/// Points that were given go to the part whose wall is nearest.
std::vector<PartRequest> shared_out(const std::vector<TriMesh>& parts, const AxesRequest& request) {
  std::vector<PartRequest> all(parts.size());
  std::vector<geometry::AabbTree> trees;
  if (parts.size() > 1)
    for (const TriMesh& part : parts) trees.emplace_back(part);
  const auto nearest = [&](const Vec3& p) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    if (!p.allFinite()) return best;  // extract_centerlines says so
    for (std::size_t i = 0; i < trees.size(); ++i)
      if (const double d = trees[i].closest(p).distance; d < least) least = d, best = i;
    return best;
  };
  for (const Vec3& source : request.sources)
    if (auto& here = all[nearest(source)].source; !here) here = source;
  for (std::size_t i = 0; i < request.targets.size(); ++i) {
    PartRequest& part = all[nearest(request.targets[i])];
    part.targets.push_back(request.targets[i]);
    part.names.push_back(request.target_names.empty() ? "" : request.target_names[i]);
  }
  return all;
}

/// One part's ends: its inlet and its targets, those asked for first.
struct PartEnds {
  std::optional<Vec3> source;
  std::vector<End> targets;
  bool leave_blind = false;  ///< blind branches stay closed: they are only told
  std::vector<std::string> told;
};

std::size_t inlet_among(const std::vector<End>& ends) {
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i].kind == geometry::FaceKind::inlet) return i;
  const auto widest = std::ranges::max_element(ends, {}, [](const End& e) {
    return e.radius_mm - (e.blind ? 1e6 : 0.0);  // an open end before a blind one
  });
  return static_cast<std::size_t>(widest - ends.begin());
}

std::vector<End> blind_ends(const TriMesh& part, const PartRequest& asked, const std::optional<Vec3>& from,
                            const core::TaskContext& task) {
  std::vector<End> ends;
  for (const centerline::SurfaceTip& tip : centerline::find_tips(part, from, {}, task)) {
    const bool covered = std::ranges::any_of(asked.targets, [&](const Vec3& target) {
      return distance_to(target, tip.way) <= on_branch_radii * tip.radius_mm;
    });
    if (!covered) ends.push_back({tip.inside, tip.radius_mm, "", {}, false, true, tip.length_mm});
  }
  return ends;
}

End end_at(const centerline::SurfaceTip& tip) {
  return {tip.inside, tip.radius_mm, "", {}, false, true, tip.length_mm};
}

/// Of a closed part of which nothing else is known: the widest end, where it begins, may be short.
std::vector<End> ends_of_closed_part(const TriMesh& part, std::vector<std::string>& told,
                                     const core::TaskContext& task) {
  centerline::TipOptions options;
  const double long_radii = options.least_length_radii;
  options.least_length_radii = least_stub_radii;
  std::vector<End> ends;
  std::vector<centerline::SurfaceTip> trunks;
  double widest = 0.0;
  for (const centerline::SurfaceTip& tip : centerline::find_tips(part, std::nullopt, options, task)) {
    if (tip.length_mm < long_radii * tip.radius_mm) {
      trunks.push_back(tip);
      continue;
    }
    ends.push_back(end_at(tip));
    widest = std::max(widest, tip.radius_mm);
  }
  if (ends.empty()) return ends;
  for (const centerline::SurfaceTip& tip : trunks) {
    if (tip.radius_mm < wider_than_branches * widest) continue;
    const std::string what = core::fixed_text(tip.length_mm, 1) + " mm long and " +
                             core::fixed_text(2.0 * tip.radius_mm, 1) + " mm wide at " + in_words(tip.inside);
    if (tip.neck < least_neck || tip.length_mm < short_trunk_radii * tip.radius_mm) {
      told.push_back("a bulge or stub " + what +
                     " is not taken as an end, although no branch is as wide: if the " +
                     "vessels begin there, say so with --source");
      continue;
    }
    told.push_back("a short trunk " + what + " is taken as an end; --source says otherwise");
    ends.push_back(end_at(tip));
  }
  return ends;
}

PartEnds ends_of_part(const TriMesh& part, const PartRequest& asked, const AxesRequest& request,
                      const core::TaskContext& task) {
  PartEnds out;
  std::vector<End> found = open_ends(part, request.ends, request.known.get());
  out.source = asked.source;
  if (!out.source && !found.empty()) {
    const std::size_t inlet = inlet_among(found);
    out.source = found[inlet].point;
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(inlet));
  } else if (out.source) {
    if (const auto meant = end_meant_by(*out.source, found)) {
      out.source = found[*meant].point;
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(*meant));
    }
  }
  for (std::size_t i = 0; i < asked.targets.size(); ++i) {
    End end{asked.targets[i], 0.0, asked.names[i], {}, true, false, 0.0};
    if (const auto meant = end_meant_by(end.point, found)) {
      end.point = found[*meant].point;
      if (end.name.empty()) end.name = found[*meant].name;
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(*meant));
    }
    out.targets.push_back(end);
  }
  if (!asked.targets.empty() && request.side_branches == SideBranches::asked_only) return out;
  out.targets.insert(out.targets.end(), found.begin(), found.end());
  out.leave_blind = !out.targets.empty() && (request.side_branches == SideBranches::closed ||
                                             request.side_branches == SideBranches::asked_only);
  if (out.leave_blind) return out;
  const bool nothing_known = !out.source && out.targets.empty();
  std::vector<End> blind =
      nothing_known ? ends_of_closed_part(part, out.told, task) : blind_ends(part, asked, out.source, task);
  if (!out.source && !blind.empty()) {
    const std::size_t inlet = inlet_among(blind);
    out.source = blind[inlet].point;
    blind.erase(blind.begin() + static_cast<std::ptrdiff_t>(inlet));
  }
  out.targets.insert(out.targets.end(), blind.begin(), blind.end());
  return out;
}

/// `closed`: blind branches that are left so.
void tell(const PartEnds& ends, const std::vector<End>& closed, bool chosen, std::vector<std::string>& told) {
  const auto branch = [](const End& end) {
    return "a branch " + core::fixed_text(end.length_mm, 1) + " mm long ends blindly at " +
           in_words(end.point);
  };
  std::size_t found = 0;
  for (const End& end : ends.targets) {
    found += end.blind && !chosen;
    if (!chosen || end.asked) continue;
    told.push_back(
        (end.blind ? branch(end) : "an open end that no target means is at " + in_words(end.point)) +
        ": it gets an axis and the outlet " + end.name);
  }
  for (const End& end : closed)
    told.push_back(branch(end) + " and stays closed (--side-branches axes or stubs give it an outlet)");
  if (found > 0)
    told.push_back("closed ends found: " + std::to_string(found) + "; the vessels begin at " +
                   in_words(*ends.source) + " (--source and --target say otherwise)");
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
  const auto name_of = [&](const End& end) {
    const std::string base = !end.name.empty()      ? end.name
                             : chosen && !end.asked ? "side_" + std::to_string(++side)
                                                    : "vessel_" + std::to_string(++number);
    std::string name = base;
    for (int k = 2; !taken.insert(name).second; ++k) name = base + "_" + std::to_string(k);
    return name;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const core::TaskContext part_task = share_of(task, i, parts.size());
    PartEnds ends = ends_of_part(parts[i], asked[i], request, part_task);
    centerline::CenterlineOptions options = request.centerline;
    const bool name_them = options.vessel_names.empty();
    std::vector<Vec3> targets;
    std::vector<std::string> stubs;
    for (End& end : ends.targets) {
      targets.push_back(end.point);
      if (!name_them) continue;
      end.name = name_of(end);
      options.vessel_names.push_back(end.name);
      if (chosen && !end.asked && request.side_branches == SideBranches::stubs) stubs.push_back(end.name);
    }
    std::vector<End> closed;
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
    append_tree(axes.tree, std::move(found.tree));
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
    if (std::ranges::any_of(ends.targets, [](const End& end) { return !end.asked; }))
      return lumen_axes(lumen, request, task);
  }
  return std::nullopt;
}

}  // namespace ostia::pipeline
