#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

namespace ostia::geometry {
namespace {

using detail::corner;
using detail::HalfEdge;

constexpr std::size_t most_examples = 10;

/// The first places of each kind of fault; shared out in turn, so that no kind crowds out the others.
class Examples {
 public:
  void add(std::size_t kind, const Vec3& place) {
    if (places_.size() <= kind) places_.resize(kind + 1);
    if (places_[kind].size() < most_examples && place.allFinite()) places_[kind].push_back(place);
  }
  std::vector<Vec3> chosen() const {
    std::vector<Vec3> result;
    for (std::size_t turn = 0; turn < most_examples; ++turn) {
      for (const auto& kind : places_) {
        if (turn < kind.size() && result.size() < most_examples) result.push_back(kind[turn]);
      }
    }
    return result;
  }

 private:
  std::vector<std::vector<Vec3>> places_;
};

enum FaultKind : std::size_t {
  self_intersection,
  open_edge,
  non_manifold_edge,
  non_manifold_vertex,
  inconsistent_edge,
  degenerate_triangle,
  duplicate_triangle,
  duplicate_point,
  unused_point,
};

Vec3 centroid(const TriMesh& mesh, std::int32_t triangle) {
  const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  return (corner(mesh, t, 0) + corner(mesh, t, 1) + corner(mesh, t, 2)) / 3.0;
}

void count_point_faults(const TriMesh& mesh, SurfaceFaults& faults, Examples& examples) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t p : t) used[static_cast<std::size_t>(p)] = 1;
  }
  const std::vector<std::int32_t> first = detail::first_equal_points(mesh.points);
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    if (!mesh.points[p].allFinite()) ++faults.non_finite_points;
    if (first[p] != static_cast<std::int32_t>(p)) {
      ++faults.duplicate_points;
      examples.add(duplicate_point, mesh.points[p]);
    }
    if (!used[p]) {
      ++faults.unused_points;
      examples.add(unused_point, mesh.points[p]);
    }
  }
}

void count_triangle_faults(const TriMesh& mesh, SurfaceFaults& faults, Examples& examples) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!detail::is_degenerate(mesh, mesh.triangles[t])) continue;
    ++faults.degenerate_triangles;
    examples.add(degenerate_triangle, centroid(mesh, static_cast<std::int32_t>(t)));
  }
  const std::vector<detail::CornersOfTriangle> sorted = detail::sorted_corners(mesh);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].corners != sorted[i - 1].corners) continue;
    ++faults.duplicate_triangles;
    examples.add(duplicate_triangle, centroid(mesh, sorted[i].triangle));
  }
}

void count_edge_faults(const TriMesh& mesh, const std::vector<HalfEdge>& table, SurfaceFaults& faults,
                       Examples& examples) {
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    const Vec3 middle = 0.5 * (mesh.points[static_cast<std::size_t>(first->low)] +
                               mesh.points[static_cast<std::size_t>(first->high)]);
    if (last - first == 1) {
      ++faults.open_edges;
      examples.add(open_edge, middle);
    } else if (last - first > 2) {
      ++faults.non_manifold_edges;
      examples.add(non_manifold_edge, middle);
    } else if (first[0].ascending == first[1].ascending) {
      ++faults.inconsistent_edges;
      examples.add(inconsistent_edge, middle);
    }
  });
}

/// Joins, around each vertex, the corners of triangles that share an edge there; more than one set is more
/// than one fan.
void count_vertex_faults(const TriMesh& mesh, const std::vector<HalfEdge>& table, SurfaceFaults& faults,
                         Examples& examples) {
  DisjointSets corners(3 * mesh.triangles.size());
  const auto corner_at = [&](const HalfEdge& h, std::int32_t vertex) {
    const std::int32_t side = h.from() == vertex ? h.side : (h.side + 1) % 3;
    return 3 * h.triangle + side;
  };
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* other = first + 1; other != last; ++other) {
      corners.join(corner_at(*first, first->low), corner_at(*other, first->low));
      corners.join(corner_at(*first, first->high), corner_at(*other, first->high));
    }
  });
  std::vector<std::int32_t> fan(mesh.points.size(), -1);
  std::vector<char> split(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (detail::repeats_a_corner(mesh.triangles[t])) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto vertex = static_cast<std::size_t>(mesh.triangles[t][i]);
      const std::int32_t set = corners.find(static_cast<std::int32_t>(3 * t + i));
      if (fan[vertex] < 0) fan[vertex] = set;
      if (fan[vertex] == set || split[vertex]) continue;
      split[vertex] = 1;
      ++faults.non_manifold_vertices;
      examples.add(non_manifold_vertex, mesh.points[vertex]);
    }
  }
}

}  // namespace

SurfaceFaults find_faults(const TriMesh& mesh, bool with_self_intersections) {
  detail::check_indices(mesh, "surface check");
  SurfaceFaults faults;
  Examples examples;
  count_point_faults(mesh, faults, examples);
  count_triangle_faults(mesh, faults, examples);
  const std::vector<HalfEdge> table = detail::half_edges(mesh);
  count_edge_faults(mesh, table, faults, examples);
  count_vertex_faults(mesh, table, faults, examples);
  for (const std::int32_t number : detail::components(mesh, table)) {
    faults.components = std::max(faults.components, static_cast<std::size_t>(number) + 1);
  }
  if (with_self_intersections) {
    const auto pairs = self_intersections(mesh);
    faults.self_intersections = pairs.size();
    for (const auto& [a, b] : pairs) {
      examples.add(self_intersection, 0.5 * (centroid(mesh, a) + centroid(mesh, b)));
    }
  }
  faults.examples = examples.chosen();
  return faults;
}

bool SurfaceFaults::closed_manifold() const {
  return components > 0 && non_finite_points == 0 && duplicate_points == 0 && degenerate_triangles == 0 &&
         duplicate_triangles == 0 && open_edges == 0 && non_manifold_edges == 0 &&
         non_manifold_vertices == 0 && inconsistent_edges == 0 && self_intersections == 0;
}

std::string SurfaceFaults::summary() const {
  struct Line {
    std::size_t count;
    const char* one;
    const char* many;
  };
  const std::array lines{
      Line{non_finite_points, "point that is not finite", "points that are not finite"},
      Line{duplicate_points, "duplicate point", "duplicate points"},
      Line{unused_points, "unused point", "unused points"},
      Line{degenerate_triangles, "degenerate triangle", "degenerate triangles"},
      Line{duplicate_triangles, "duplicate triangle", "duplicate triangles"},
      Line{open_edges, "open edge", "open edges"},
      Line{non_manifold_edges, "non-manifold edge", "non-manifold edges"},
      Line{non_manifold_vertices, "non-manifold vertex", "non-manifold vertices"},
      Line{inconsistent_edges, "inconsistent edge", "inconsistent edges"},
      Line{self_intersections, "self-intersection", "self-intersections"},
  };
  std::string text;
  for (const Line& line : lines) {
    if (line.count == 0) continue;
    if (!text.empty()) text += ", ";
    text += std::to_string(line.count) + " " + (line.count == 1 ? line.one : line.many);
  }
  return text.empty() ? "none" : text;
}

}  // namespace ostia::geometry
