#include "ostia/pipeline/repair.h"

#include "intake/crossings.h"
#include "intake/specks.h"
#include "intake/spikes.h"
#include "motion/unfolding.h"

#include "ostia/centerline/lumen_surface.h"
#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/non_manifold.h"
#include "ostia/pipeline/lumen_axes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr int rounds = 6;  // cutting out one fold can bring the next to light

void note(Repaired& out, const std::string& what, std::size_t count, const std::string& text) {
  if (count == 0) return;
  out.done.push_back(text + ": " + std::to_string(count));
  out.steps.push_back({what, count, out.done.back()});
}

/// Keeps some of the triangles, and says how many went.
void keep_some(Repaired& out, const std::vector<bool>& keep, const std::string& what,
               const std::string& text) {
  const auto gone = static_cast<std::size_t>(std::count(keep.begin(), keep.end(), false));
  if (gone == 0) return;
  out.mesh = geometry::subset(out.mesh, keep);
  note(out, what, gone, text);
}

void drop_not_finite(Repaired& out) {
  const TriMesh& mesh = out.mesh;
  std::vector<bool> keep;
  for (const geometry::Triangle& t : mesh.triangles) {
    keep.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t p) {
      return mesh.points[static_cast<std::size_t>(p)].allFinite();
    }));
  }
  keep_some(out, keep, "not_finite_triangles_dropped", "triangles with points that are not finite dropped");
}

/// Equal points, triangles without area, triangles there twice: one function does away with all three, and
/// the counts are those of the faults it found.
void weld(Repaired& out) {
  TriMesh joined = geometry::welded(out.mesh);
  const std::size_t before = out.mesh.triangles.size(), after = joined.triangles.size();
  const bool all_stays = joined.points.size() == out.mesh.points.size() && before == after;
  if (!all_stays) {  // else it had none of the three
    const geometry::SurfaceFaults faults = geometry::find_faults(out.mesh, false);
    const std::size_t gone = before - std::min(before, after);
    const std::size_t flat = std::min(gone, faults.degenerate_triangles);
    note(out, "equal_points_joined", faults.duplicate_points, "points equal to another one joined");
    note(out, "degenerate_triangles_dropped", flat, "triangles that were degenerate dropped");
    note(out, "duplicate_triangles_dropped", gone - flat, "triangles that were there twice dropped");
  }
  out.mesh = std::move(joined);
  if (out.mesh.triangles.empty())
    throw GeometryError("nothing of the surface is left after dropping bad triangles");
}

void take_apart(Repaired& out) {
  geometry::Separated apart = geometry::separated(out.mesh);
  out.mesh = std::move(apart.mesh);
  note(out, "points_split", apart.added_points, "points split where parts of the surface only touched");
}

/// Volume about the surface's own middle: its sign tells the way an open one faces, too.
double facing(const TriMesh& mesh) {
  TriMesh moved = mesh;
  const geometry::Vec3 middle = geometry::bounds(mesh.points).center();
  for (geometry::Vec3& p : moved.points) p -= middle;
  return geometry::volume(moved);
}

void turn_together(Repaired& out) {
  TriMesh turned = geometry::oriented(out.mesh);
  std::size_t count = 0;
  for (std::size_t t = 0; t < turned.triangles.size(); ++t)
    count += turned.triangles[t] != out.mesh.triangles[t];
  out.mesh = std::move(turned);
  note(out, "triangles_turned", count, "triangles turned the way of the others, or outward");
}

/// Each part as a lumen that centerlines can be made of; parts of which nothing would be left go.
TriMesh prepared(const TriMesh& mesh) {
  std::vector<TriMesh> parts;
  std::optional<GeometryError> failed;
  for (const TriMesh& part : parts_of(mesh)) {
    try {
      parts.push_back(centerline::simple_wall(part));
    } catch (const GeometryError& error) {
      failed = error;
    }
  }
  if (parts.empty() && failed) throw GeometryError(*failed);
  return joined(parts);
}

/// Flaps on edges where three sheets join go, and each part faces outward.
void make_simple(Repaired& out) {
  const std::size_t before = out.mesh.triangles.size();
  const double faced = facing(out.mesh);
  out.mesh = prepared(out.mesh);
  note(out, "non_manifold_triangles_dropped", before - std::min(before, out.mesh.triangles.size()),
       "triangles on non-manifold edges dropped");
  if (faced * facing(out.mesh) < 0.0 && before == out.mesh.triangles.size())
    note(out, "triangles_turned_outward", before, "triangles, all of them, turned outward");
}

void keep_largest_part(Repaired& out) {
  const std::vector<std::int32_t> part = geometry::components(out.mesh);
  std::map<std::int32_t, double> areas;
  for (std::size_t t = 0; t < part.size(); ++t) {
    const auto& [a, b, c] = out.mesh.triangles[t];
    const auto& p = out.mesh.points;
    areas[part[t]] += (p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)])
                          .cross(p[static_cast<std::size_t>(c)] - p[static_cast<std::size_t>(a)])
                          .norm();
  }
  if (areas.size() < 2) return;
  const auto largest = std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                       })->first;
  std::vector<bool> keep;
  for (const std::int32_t p : part) keep.push_back(p == largest);
  keep_some(out, keep, "small_parts_triangles_dropped",
            "triangles of smaller parts (" + std::to_string(areas.size() - 1) + ") dropped");
}

void keep_vessels(Repaired& out) {
  std::vector<TriMesh> parts = parts_of(out.mesh);
  const Specks gone = drop_specks(parts);
  if (gone.count() == 0) return;
  out.mesh = joined(parts);
  out.done.push_back(gone.text());
  out.steps.push_back({"specks_dropped", gone.count(), gone.text()});
}

void keep_parts(Repaired& out, KeptParts which) {
  if (which == KeptParts::largest) keep_largest_part(out);
  if (which == KeptParts::vessels) keep_vessels(out);
}

/// Without the triangles that intersect others, and those `rings` times around them.
TriMesh without_folds(const TriMesh& mesh, const Crossings& pairs, int rings,
                      std::set<std::array<double, 3>>& rim) {
  std::set<std::int32_t> points;
  for (const auto& [a, b] : pairs) {
    for (const std::int32_t t : {a, b})
      points.insert(mesh.triangles[static_cast<std::size_t>(t)].begin(),
                    mesh.triangles[static_cast<std::size_t>(t)].end());
  }
  for (int ring = 1; ring < rings; ++ring) {
    const std::set<std::int32_t> inner = points;
    for (const geometry::Triangle& t : mesh.triangles)
      if (std::any_of(t.begin(), t.end(), [&](std::int32_t p) { return inner.contains(p); }))
        points.insert(t.begin(), t.end());
  }
  std::vector<bool> keep;
  for (const geometry::Triangle& t : mesh.triangles) {
    const bool touched = std::any_of(t.begin(), t.end(), [&](std::int32_t p) { return points.contains(p); });
    keep.push_back(!touched);
    if (!touched) continue;
    for (const std::int32_t p : t) {
      const geometry::Vec3& x = mesh.points[static_cast<std::size_t>(p)];
      rim.insert({x.x(), x.y(), x.z()});
    }
  }
  return geometry::subset(mesh, keep);
}

/// Closes the holes that are marked, in the order of boundary_loops.
TriMesh with_some_closed(const TriMesh& mesh, const std::vector<bool>& which) {
  const geometry::FilledHoles filled = geometry::fill_holes(mesh);
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle)
    keep.push_back(hole < 0 || which[static_cast<std::size_t>(hole)]);
  return geometry::subset(filled.mesh, keep);
}

/// Closes the holes all of whose points lie on `rim`.
TriMesh with_rim_closed(const TriMesh& mesh, const std::set<std::array<double, 3>>& rim) {
  const auto loops = geometry::boundary_loops(mesh);
  std::vector<bool> ours;
  for (const auto& loop : loops) {
    ours.push_back(std::all_of(loop.begin(), loop.end(), [&](std::int32_t p) {
      const geometry::Vec3& x = mesh.points[static_cast<std::size_t>(p)];
      return rim.contains({x.x(), x.y(), x.z()});
    }));
  }
  return with_some_closed(mesh, ours);
}

KnownCrossings pull_spikes_in(Repaired& out) {
  PulledIn pulled = pull_in_spikes(out.mesh);
  note(out, "spikes_pulled_in", pulled.count, "spikes of one point pulled in");
  return std::move(pulled.crossings);
}

/// What crosses itself because it is rough is made smooth before anything is cut.
void smooth_folds(Repaired& out, KnownCrossings& known, const core::TaskContext& task) {
  const Unfolded smoothed = unfold(out.mesh, known, task);
  if (smoothed.crossings == 0) return;
  note(out, "self_intersections_smoothed", smoothed.crossings,
       smoothed.everywhere ? "self-intersections of a wall that is rough all over smoothed away"
                           : "self-intersections smoothed away");
  if (smoothed.everywhere) out.rough = "points of a wall that is rough all over " + smoothed.text();
}

/// Whether none is left.
bool cut_folds_out(Repaired& out, KnownCrossings known, const RepairOptions& options,
                   const core::TaskContext& task) {
  for (int round = 0; round < rounds; ++round) {
    task.throw_if_cancelled();
    const Crossings pairs = known ? std::move(*known) : geometry::self_intersections(out.mesh);
    known.reset();
    if (pairs.empty()) return true;
    std::set<std::array<double, 3>> rim;
    const TriMesh open =
        without_folds(out.mesh, pairs, 1 + round / 2, rim);  // what comes back is cut out wider
    out.mesh = with_rim_closed(prepared(open), rim);
    note(out, "self_intersections_cut_out", pairs.size(), "self-intersections cut out and closed");
    keep_parts(out, options.parts);
  }
  return false;
}

/// Whether there were any.
bool close_holes(Repaired& out, double up_to_mm) {
  if (!(up_to_mm > 0.0)) return false;
  const auto loops = geometry::boundary_loops(out.mesh);
  std::vector<bool> small;
  for (const auto& loop : loops) {
    double around = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      around += (out.mesh.points[static_cast<std::size_t>(loop[i])] -
                 out.mesh.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])])
                    .norm();
    small.push_back(around <= up_to_mm * std::numbers::pi);
  }
  const auto count = static_cast<std::size_t>(std::count(small.begin(), small.end(), true));
  if (count == 0) return false;
  out.mesh = with_some_closed(out.mesh, small);
  note(out, "holes_filled", count, "holes filled");
  return true;
}

}  // namespace

void validate(const RepairOptions& options) {
  if (!(options.fill_holes_up_to_mm >= 0.0))
    throw InvalidInput("repair: fill_holes_up_to_mm " + std::to_string(options.fill_holes_up_to_mm) +
                       " must be 0 or more");
}

Repaired repaired(const TriMesh& mesh, const RepairOptions& options, const core::TaskContext& task) {
  validate(options);
  Repaired out;
  out.mesh = mesh;
  drop_not_finite(out);
  weld(out);
  task.throw_if_cancelled();
  take_apart(out);
  turn_together(out);
  make_simple(out);
  take_apart(out);  // dropping flaps can leave borders that touch
  keep_parts(out, options.parts);
  KnownCrossings crossings = pull_spikes_in(out);
  smooth_folds(out, crossings, task);
  const bool no_folds = cut_folds_out(out, std::move(crossings), options, task);
  const bool closed_some = close_holes(out, options.fill_holes_up_to_mm);
  // What was just found to have none is not searched once more.
  geometry::SurfaceFaults faults = geometry::find_faults(out.mesh, closed_some || !no_folds);
  faults.open_edges = 0;
  out.left = faults.components == 0 ? "no triangle, all were cut out" : faults.summary();
  out.meshable = faults.closed_manifold();
  return out;
}

Repaired repaired(const TriMesh& mesh, const core::TaskContext& task) {
  return repaired(mesh, RepairOptions{}, task);
}

}  // namespace ostia::pipeline
