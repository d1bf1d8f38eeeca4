#include "coronaries/surface_refine.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace ostia::phantom {
namespace {

using geometry::Triangle;
using geometry::TriMesh;

constexpr double tolerance_mm = 0.005, alike = 0.8;
constexpr int passes = 3, untangling_rounds = 6;

using Edge = std::pair<std::int32_t, std::int32_t>;

Edge edge_of(std::int32_t a, std::int32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

std::vector<Edge> edges_of(const TriMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size() / 2);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {  // of a closed surface each edge runs upwards once
      if (t[c] < t[(c + 1) % 3]) edges.emplace_back(t[c], t[(c + 1) % 3]);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// One triangle by the new vertices on its sides (-1: none), in place of the old one.
void split(const Triangle& t, std::array<std::int32_t, 3> middle, const std::vector<Vec3>& points,
           std::vector<Triangle>& out) {
  const auto count = std::count_if(middle.begin(), middle.end(), [](std::int32_t m) { return m >= 0; });
  if (count == 0) {
    out.push_back(t);
    return;
  }
  if (count == 3) {
    for (std::size_t c = 0; c < 3; ++c) out.push_back({t[c], middle[c], middle[(c + 2) % 3]});
    out.push_back({middle[0], middle[1], middle[2]});
    return;
  }
  // Turned so that side 0 is the only one split, or side 2 the only one that is not.
  std::size_t turn = 0;
  while (count == 1 ? middle[turn] < 0 : middle[(turn + 2) % 3] >= 0) ++turn;
  const std::int32_t a = t[turn], b = t[(turn + 1) % 3], c = t[(turn + 2) % 3];
  const std::int32_t ab = middle[turn], bc = middle[(turn + 1) % 3];
  if (count == 1) {
    out.push_back({a, ab, c});
    out.push_back({ab, b, c});
    return;
  }
  out.push_back({ab, b, bc});
  const auto length = [&](std::int32_t i, std::int32_t j) {
    return (points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(j)]).squaredNorm();
  };
  if (length(a, bc) < length(ab, c)) {
    out.push_back({a, ab, bc});
    out.push_back({a, bc, c});
  } else {
    out.push_back({a, ab, c});
    out.push_back({ab, bc, c});
  }
}

/// New vertices on the edges that need one; their numbers, one an edge (-1: none).
std::vector<std::int32_t> split_edges(const ImplicitField& f, TriMesh& mesh, const std::vector<Edge>& edges,
                                      double crease_mm, const core::TaskContext& task) {
  const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
  std::vector<Vec3> middles(edges.size());
  std::vector<std::int32_t> numbers(edges.size(), -1);
  core::parallel_chunks(edges.size(), 4096, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t e = first; e < last; ++e) {
      const auto a = static_cast<std::size_t>(edges[e].first), b = static_cast<std::size_t>(edges[e].second);
      Vec3 p = 0.5 * (mesh.points[a] + mesh.points[b]);
      const double off = std::abs(f(p));
      if (off <= tolerance_mm || off > crease_mm || normals[a].dot(normals[b]) < alike) continue;
      const double reach = std::min(crease_mm, 0.35 * (mesh.points[a] - mesh.points[b]).norm());
      if (!project(f, p, reach)) continue;
      middles[e] = p;
      numbers[e] = 0;
    }
  });
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (numbers[e] < 0) continue;
    numbers[e] = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(middles[e]);
  }
  return numbers;
}

/// New vertices of triangles that cross others go back to the middle of the edge they came from, which
/// changes nothing of the surface they refine.
void untangle(TriMesh& mesh, const std::vector<Edge>& parents, const core::TaskContext& task) {
  const std::size_t given = mesh.points.size() - parents.size();
  for (int round = 0; round < untangling_rounds; ++round) {
    task.throw_if_cancelled();
    std::vector<std::size_t> back;
    for (const auto& [one, other] : geometry::self_intersections(mesh)) {
      for (const std::int32_t triangle : {one, other}) {
        for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(triangle)]) {
          if (static_cast<std::size_t>(v) >= given) back.push_back(static_cast<std::size_t>(v));
        }
      }
    }
    if (back.empty()) return;
    std::sort(back.begin(), back.end());  // parents before their children
    for (const std::size_t v : back) {
      const auto& [a, b] = parents[v - given];
      mesh.points[v] =
          0.5 * (mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)]);
    }
  }
}

}  // namespace

void refine_to(const ImplicitField& f, TriMesh& mesh, double crease_mm, const core::TaskContext& task) {
  std::vector<Edge> parents;
  for (int pass = 0; pass < passes; ++pass) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(pass) / (passes + 1));
    const std::vector<Edge> edges = edges_of(mesh);
    const std::size_t before = mesh.points.size();
    const std::vector<std::int32_t> numbers = split_edges(f, mesh, edges, crease_mm, task);
    if (mesh.points.size() == before) break;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (numbers[e] >= 0) parents.push_back(edges[e]);
    }
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size() + 2 * (mesh.points.size() - before));
    for (const Triangle& t : mesh.triangles) {
      std::array<std::int32_t, 3> middle{};
      for (std::size_t c = 0; c < 3; ++c) {
        const Edge edge = edge_of(t[c], t[(c + 1) % 3]);
        const auto at = std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin();
        middle[c] = numbers[static_cast<std::size_t>(at)];
      }
      split(t, middle, mesh.points, triangles);
    }
    mesh.triangles = std::move(triangles);
  }
  untangle(mesh, parents, task);
  task.set_progress(1.0);
}

}  // namespace ostia::phantom
