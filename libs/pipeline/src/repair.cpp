#include "ostia/pipeline/repair.h"

#include "ostia/centerline/lumen_surface.h"
#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr int rounds = 4;  // cutting out one fold can bring the next to light

void note(Repaired& out, std::size_t before, const std::string& what) {
  const std::size_t after = out.mesh.triangles.size();
  if (after < before) out.done.push_back(std::to_string(before - after) + " triangles " + what + " dropped");
}

void drop_not_finite(Repaired& out) {
  const TriMesh& mesh = out.mesh;
  const std::size_t before = mesh.triangles.size();
  std::vector<bool> keep;
  for (const geometry::Triangle& t : mesh.triangles) {
    keep.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t p) {
      return mesh.points[static_cast<std::size_t>(p)].allFinite();
    }));
  }
  out.mesh = geometry::subset(mesh, keep);
  note(out, before, "with points that are not finite");
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
  const std::size_t before = out.mesh.triangles.size();
  out.mesh = geometry::subset(out.mesh, keep);
  note(out, before, "of " + std::to_string(areas.size() - 1) + " smaller parts");
}

/// Without the triangles that intersect others, and those around them.
TriMesh without_folds(const TriMesh& mesh, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs,
                      std::set<std::array<double, 3>>& rim) {
  std::set<std::int32_t> points;
  for (const auto& [a, b] : pairs) {
    for (const std::int32_t t : {a, b})
      points.insert(mesh.triangles[static_cast<std::size_t>(t)].begin(),
                    mesh.triangles[static_cast<std::size_t>(t)].end());
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
  const geometry::FilledHoles filled = geometry::fill_holes(mesh);
  std::vector<bool> keep;
  for (const std::int32_t hole : filled.hole_of_triangle)
    keep.push_back(hole < 0 || ours[static_cast<std::size_t>(hole)]);
  return geometry::subset(filled.mesh, keep);
}

void cut_folds_out(Repaired& out, const core::TaskContext& task) {
  for (int round = 0; round < rounds; ++round) {
    task.throw_if_cancelled();
    const auto pairs = geometry::self_intersections(out.mesh);
    if (pairs.empty()) return;
    std::set<std::array<double, 3>> rim;
    const TriMesh open = without_folds(out.mesh, pairs, rim);
    out.mesh = with_rim_closed(centerline::prepare_lumen(open).wall, rim);
    out.done.push_back(std::to_string(pairs.size()) + " self-intersections cut out and closed");
    keep_largest_part(out);
  }
}

}  // namespace

Repaired repaired(const TriMesh& mesh, const core::TaskContext& task) {
  Repaired out;
  out.mesh = mesh;
  drop_not_finite(out);
  const std::size_t before_weld = out.mesh.triangles.size();
  out.mesh = geometry::welded(out.mesh);
  note(out, before_weld, "that were degenerate or there twice");
  if (out.mesh.triangles.empty())
    throw GeometryError("nothing of the surface is left after dropping bad triangles");
  const std::size_t before_flaps = out.mesh.triangles.size();
  out.mesh = centerline::prepare_lumen(out.mesh).wall;
  note(out, before_flaps, "on non-manifold edges");
  keep_largest_part(out);
  cut_folds_out(out, task);
  geometry::SurfaceFaults faults = geometry::find_faults(out.mesh, true);
  faults.open_edges = 0;
  out.left = faults.summary();
  return out;
}

}  // namespace ostia::pipeline
