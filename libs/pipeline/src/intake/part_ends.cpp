#include "intake/part_ends.h"

#include "intake/intake_ends.h"

#include "ostia/centerline/end_points.h"
#include "ostia/centerline/surface_tips.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <limits>
#include <utility>

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

std::vector<Vec3> holes_in_wall(const TriMesh& part, const std::vector<std::vector<std::int32_t>>& loops) {
  const geometry::AabbTree closed(geometry::fill_holes(part).mesh);
  std::vector<Vec3> holes;
  for (const auto& loop : loops)
    if (const meshing::GivenEnd end = meshing::end_at_loop(part, loop); meshing::is_hole_in_wall(closed, end))
      holes.push_back(end.centre);
  return holes;
}

/// Openings that are no holes in the wall, longest border first.
std::vector<PartEnd> open_ends(const TriMesh& part, const std::vector<meshing::GivenEnd>& given,
                               const centerline::KnownSurface* known) {
  std::vector<PartEnd> ends;
  const auto loops = known != nullptr ? known->loops : geometry::boundary_loops(part);
  if (loops.empty()) return ends;
  const std::vector<Vec3> holes = known != nullptr ? std::vector<Vec3>{} : holes_in_wall(part, loops);
  for (const centerline::Opening& opening : centerline::find_openings(part, loops)) {
    if (std::ranges::any_of(holes, [&](const Vec3& hole) { return (hole - opening.centre).norm() < 1e-9; }))
      continue;
    PartEnd end{opening.centre, opening.radius, "", {}, false, false, 0.0};
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
std::optional<std::size_t> end_meant_by(const Vec3& point, const std::vector<PartEnd>& ends) {
  std::optional<std::size_t> best;
  const auto distance = [&](std::size_t i) { return (point - ends[i].point).norm(); };
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (distance(i) <= means_end_radii * ends[i].radius_mm && (!best || distance(i) < distance(*best)))
      best = i;
  return best;
}

std::size_t inlet_among(const std::vector<PartEnd>& ends) {
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i].kind == geometry::FaceKind::inlet) return i;
  const auto widest = std::ranges::max_element(ends, {}, [](const PartEnd& e) {
    return e.radius_mm - (e.blind ? 1e6 : 0.0);  // an open end before a blind one
  });
  return static_cast<std::size_t>(widest - ends.begin());
}

PartEnd end_at(const centerline::SurfaceTip& tip) {
  return {tip.inside, tip.radius_mm, "", {}, false, true, tip.length_mm};
}

/// Of a closed part of which nothing else is known: the widest end, where it begins, may be short.
std::vector<PartEnd> ends_of_closed_part(const TriMesh& part, std::vector<std::string>& told,
                                         const core::TaskContext& task) {
  centerline::TipOptions options;
  const double long_radii = options.least_length_radii;
  options.least_length_radii = least_stub_radii;
  std::vector<PartEnd> ends;
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
                             core::fixed_text(2.0 * tip.radius_mm, 1) + " mm wide at " +
                             place_text(tip.inside);
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

}  // namespace

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

std::vector<PartEnd> blind_ends(const TriMesh& part, const PartRequest& asked,
                                const std::optional<Vec3>& from, const core::TaskContext& task) {
  std::vector<PartEnd> ends;
  for (const centerline::SurfaceTip& tip : centerline::find_tips(part, from, {}, task)) {
    const bool covered = std::ranges::any_of(asked.targets, [&](const Vec3& target) {
      return distance_to(target, tip.way) <= on_branch_radii * tip.radius_mm;
    });
    if (!covered) ends.push_back({tip.inside, tip.radius_mm, "", {}, false, true, tip.length_mm});
  }
  return ends;
}

PartEnds ends_of_part(const TriMesh& part, const PartRequest& asked, const AxesRequest& request,
                      const core::TaskContext& task) {
  PartEnds out;
  std::vector<PartEnd> found = open_ends(part, request.ends, request.known.get());
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
    PartEnd end{asked.targets[i], 0.0, asked.names[i], {}, true, false, 0.0};
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
  std::vector<PartEnd> blind =
      nothing_known ? ends_of_closed_part(part, out.told, task) : blind_ends(part, asked, out.source, task);
  if (!out.source && !blind.empty()) {
    const std::size_t inlet = inlet_among(blind);
    out.source = blind[inlet].point;
    blind.erase(blind.begin() + static_cast<std::ptrdiff_t>(inlet));
  }
  out.targets.insert(out.targets.end(), blind.begin(), blind.end());
  return out;
}

}  // namespace ostia::pipeline
