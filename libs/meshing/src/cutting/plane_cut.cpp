#include "cutting/plane_cut.h"

#include "remeshing/edit_mesh.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// Edges that a plane crosses one after the other around a branch: from the point inside to the point beyond.
struct CutLoop {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  std::vector<Vec3> points;
  double nearest_vertex = 0.0;  ///< least distance of an end of these edges from the plane
  double mean_edge = 0.0;
};

double height(const EndPlane& plane, const Vec3& p) {
  return (p - plane.origin).dot(plane.normal);
}

/// Times that the loop runs around the plane's origin.
int turns(const EndPlane& plane, const std::vector<Vec3>& loop) {
  double angle = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = loop[i] - plane.origin, b = loop[(i + 1) % loop.size()] - plane.origin;
    angle += std::atan2(a.cross(b).dot(plane.normal), a.dot(b));
  }
  return static_cast<int>(std::lround(angle / (2.0 * std::numbers::pi)));
}

double mean_distance(const Vec3& from, const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (p - from).norm();
  return sum / static_cast<double>(points.size());
}

/// The closed loop around the plane's origin, the nearest of them.
std::optional<CutLoop> find_loop(const EditMesh& mesh, const EndPlane& plane) {
  std::vector<double> heights;
  heights.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) heights.push_back(height(plane, p));
  auto beyond = [&](std::int32_t v) { return heights[static_cast<std::size_t>(v)] >= 0.0; };
  auto leaves = [&](std::int32_t h) { return !beyond(mesh.origin(h)) && beyond(mesh.target(h)); };
  std::vector<bool> seen(static_cast<std::size_t>(mesh.half_edge_count()), false);
  std::optional<CutLoop> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::int32_t first = 0; first < mesh.half_edge_count(); ++first) {
    if (seen[static_cast<std::size_t>(first)] || !leaves(first)) continue;
    CutLoop loop;
    loop.nearest_vertex = std::numeric_limits<double>::infinity();
    std::int32_t h = first;
    while (h != EditMesh::none && !seen[static_cast<std::size_t>(h)]) {
      seen[static_cast<std::size_t>(h)] = true;
      const std::int32_t a = mesh.origin(h), b = mesh.target(h);
      const double ha = heights[static_cast<std::size_t>(a)], hb = heights[static_cast<std::size_t>(b)];
      const Vec3 p = mesh.at(a) + ha / (ha - hb) * (mesh.at(b) - mesh.at(a));
      loop.edges.emplace_back(a, b);
      loop.points.push_back(p - height(plane, p) * plane.normal);
      loop.nearest_vertex = std::min({loop.nearest_vertex, -ha, hb});
      loop.mean_edge += mesh.length(h);
      // The face's other crossing edge comes back; its twin leaves again in the next face.
      const std::int32_t n = EditMesh::next(h);
      h = mesh.twin(beyond(mesh.target(n)) ? EditMesh::prev(h) : n);
    }
    if (h != first) continue;  // ran into a border
    loop.mean_edge /= static_cast<double>(loop.edges.size());
    const double distance = mean_distance(plane.origin, loop.points);
    if (std::abs(turns(plane, loop.points)) == 1 && distance < best_distance) {
      best_distance = distance;
      best = std::move(loop);
    }
  }
  return best;
}

/// The loop of a plane that keeps clear of vertices: a small shift inside where it does not.
CutLoop clear_loop(const EditMesh& mesh, EndPlane& plane, const std::string& name) {
  const Vec3 wanted = plane.origin;
  std::optional<CutLoop> best;
  Vec3 best_origin = wanted;
  for (int k = 0; k < 20; ++k) {
    plane.origin = wanted - 4e-4 * k * plane.radius_mm * plane.normal;
    auto loop = find_loop(mesh, plane);
    if (loop && (!best || loop->nearest_vertex > best->nearest_vertex)) {
      best = std::move(loop);
      best_origin = plane.origin;
    }
    if (best && best->nearest_vertex > 2e-5 * plane.radius_mm) break;
  }
  plane.origin = best_origin;
  if (!best)
    throw GeometryError(name +
                        ": the plane does not cut the surface in a closed loop around the axis; check that "
                        "centerline and surface belong together, or change the inset");
  if (!(best->nearest_vertex > 0.0))
    throw GeometryError(name + ": the plane runs through points of the surface; change the inset a little");
  return *best;
}

/// Marks the faces beyond the cut, whose edges join two points of the cut.
std::vector<bool> faces_beyond(const EditMesh& mesh, const CutLoop& loop, std::int32_t first_new,
                               const std::string& name) {
  std::vector<bool> beyond(static_cast<std::size_t>(mesh.face_count()), false);
  std::vector<std::int32_t> stack;
  auto enter = [&](std::int32_t f) {
    if (beyond[static_cast<std::size_t>(f)]) return;
    beyond[static_cast<std::size_t>(f)] = true;
    stack.push_back(f);
  };
  for (const auto& [inner, outer] : loop.edges)
    mesh.around(outer, [&](std::int32_t h) { enter(EditMesh::face(h)); });
  while (!stack.empty()) {
    const std::int32_t f = stack.back();
    stack.pop_back();
    for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h) {
      const bool on_cut = mesh.origin(h) >= first_new && mesh.target(h) >= first_new;
      if (!on_cut && mesh.twin(h) != EditMesh::none) enter(EditMesh::face(mesh.twin(h)));
    }
  }
  for (const auto& [inner, outer] : loop.edges)
    mesh.around(inner, [&](std::int32_t h) {
      if (beyond[static_cast<std::size_t>(EditMesh::face(h))])
        throw GeometryError(name +
                            ": the plane does not separate the end from the rest of the surface; the vessel "
                            "touches another one nearby");
    });
  return beyond;
}

void check_reach(const EditMesh& mesh, const std::vector<bool>& beyond, const Vec3& end, double reach,
                 const std::string& name) {
  for (std::int32_t f = 0; f < mesh.face_count(); ++f)
    if (beyond[static_cast<std::size_t>(f)])
      for (std::int32_t h = 3 * f; h < 3 * f + 3; ++h)
        if ((mesh.at(mesh.origin(h)) - end).norm() > reach)
          throw GeometryError(name + ": the cut would take away surface " +
                              std::to_string((mesh.at(mesh.origin(h)) - end).norm()) +
                              " mm from the end of the axis, more than the end itself; let the centerline "
                              "run to the vessel's end");
}

/// May a go into b without turning a triangle over?
bool folds(const EditMesh& mesh, std::int32_t a, std::int32_t b) {
  Vec3 reference = Vec3::Zero();
  mesh.around(a, [&](std::int32_t h) { reference += mesh.area_normal(EditMesh::face(h)); });
  bool bad = false;
  mesh.around(a, [&](std::int32_t h) {
    const std::int32_t x = mesh.target(h), y = mesh.origin(EditMesh::prev(h));
    if (x == b || y == b) return;
    const Vec3 n = (mesh.at(x) - mesh.at(b)).cross(mesh.at(y) - mesh.at(b));
    if (!(n.dot(reference) > 0.1 * n.norm() * reference.norm())) bad = true;
  });
  return bad;
}

bool on_plane(const EndPlane& plane, const Vec3& p) {
  return std::abs(height(plane, p)) < 1e-9 * (1.0 + p.norm()) &&
         (p - plane.origin).norm() < 20.0 * plane.radius_mm;
}

/// Would a, a point off the plane, leave an edge across the cut when it goes into b? Such an edge of the
/// wall, between points of the loop that do not follow each other, may be the very one that the cap wants.
bool bridges(const EditMesh& mesh, const EndPlane& plane, std::int32_t a, std::int32_t b) {
  if (on_plane(plane, mesh.at(a))) return false;
  std::vector<std::int32_t> of_b;
  mesh.around(b, [&](std::int32_t h) {
    of_b.push_back(mesh.target(h));
    of_b.push_back(mesh.origin(EditMesh::prev(h)));
  });
  bool bad = false;
  mesh.around(a, [&](std::int32_t h) {
    for (const std::int32_t x : {mesh.target(h), mesh.origin(EditMesh::prev(h))}) {
      if (x != b && on_plane(plane, mesh.at(x)) && std::find(of_b.begin(), of_b.end(), x) == of_b.end())
        bad = true;
    }
  });
  return bad;
}

/// Collapses the short edges that the cut has left.
void remove_slivers(EditMesh& mesh, const EndPlane& plane, double shortest) {
  for (int pass = 0; pass < 4; ++pass) {
    std::vector<std::pair<double, std::int32_t>> edges;
    for (std::int32_t h = 0; h < mesh.half_edge_count(); ++h)
      if (mesh.alive(h) && mesh.length(h) < shortest && on_plane(plane, mesh.at(mesh.target(h))))
        edges.emplace_back(mesh.length(h), h);
    std::sort(edges.begin(), edges.end());
    bool changed = false;
    for (const auto& [length, h] : edges) {
      if (!mesh.alive(h) || mesh.length(h) >= shortest || !on_plane(plane, mesh.at(mesh.target(h))) ||
          !mesh.border(mesh.target(h)))
        continue;
      if (!mesh.can_collapse(h) || folds(mesh, mesh.origin(h), mesh.target(h)) ||
          bridges(mesh, plane, mesh.origin(h), mesh.target(h)))
        continue;
      mesh.collapse(h);
      changed = true;
    }
    if (!changed) return;
  }
}

}  // namespace

geometry::TriMesh cut_branch(const geometry::TriMesh& surface, EndPlane& plane, const Vec3& end,
                             const ClipOptions& options, const std::string& name) {
  EditMesh mesh(surface);
  const CutLoop loop = clear_loop(mesh, plane, name);
  const double reach = options.reach_radii * plane.radius_mm;
  for (const Vec3& p : loop.points)
    if ((p - plane.origin).norm() > reach)
      throw GeometryError(name + ": the plane's section reaches " +
                          std::to_string((p - plane.origin).norm()) +
                          " mm from the axis, but the radius there is " + std::to_string(plane.radius_mm) +
                          " mm; check the centerline's end");
  const std::int32_t first_new = mesh.vertex_count();
  for (std::size_t i = 0; i < loop.edges.size(); ++i) {
    std::int32_t edge = EditMesh::none;
    mesh.around(loop.edges[i].first, [&](std::int32_t h) {
      if (mesh.target(h) == loop.edges[i].second) edge = h;
    });
    mesh.split(edge, loop.points[i]);
  }
  const std::vector<bool> beyond = faces_beyond(mesh, loop, first_new, name);
  check_reach(mesh, beyond, end, reach, name);
  std::vector<bool> keep(beyond.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = !beyond[i];
  EditMesh kept(geometry::subset(mesh.compact(), keep));
  remove_slivers(kept, plane, options.sliver_fraction * loop.mean_edge);
  return kept.compact();
}

}  // namespace ostia::meshing
