#include "quadratic/nodes.h"

#include "quality/mixed_elements.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

constexpr std::size_t node_grain = 8192;

const Vec3& at(const MixedMesh& mesh, std::int32_t p) {
  return mesh.points[static_cast<std::size_t>(p)];
}

template <class Visit>
void for_each_edge(const MixedMesh& mesh, const Visit& visit) {
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    for (const auto& [a, b] : tetrahedron_edges) visit(t[a], t[b]);
  for (const geometry::Prism& p : mesh.prisms)
    for (const auto& [a, b] : prism_edges) visit(p[a], p[b]);
}

using QuadKey = std::array<std::int32_t, 4>;
QuadKey key_of(QuadKey corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

QuadKey side_of(const geometry::Prism& p, std::size_t side) {
  const auto& q = prism_quads[side];
  return {p[q[0]], p[q[1]], p[q[2]], p[q[3]]};
}

/// Every quadrilateral of the prisms once, corners in order around it, sorted by their keys.
struct Quads {
  std::vector<QuadKey> keys, corners;
  std::size_t find(const QuadKey& key) const {
    const auto found = std::lower_bound(keys.begin(), keys.end(), key);
    if (found == keys.end() || *found != key)
      throw InvalidInput("quadratic elements: a boundary quadrilateral is no prism's side");
    return static_cast<std::size_t>(found - keys.begin());
  }
};

Quads quads_of(const MixedMesh& mesh) {
  std::vector<std::array<QuadKey, 2>> all;
  all.reserve(3 * mesh.prisms.size());
  for (const geometry::Prism& p : mesh.prisms)
    for (std::size_t side = 0; side < 3; ++side) {
      const QuadKey corners = side_of(p, side);
      all.push_back({key_of(corners), corners});
    }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](const auto& a, const auto& b) { return a[0] == b[0]; }),
            all.end());
  Quads quads;
  for (const auto& [key, corners] : all) quads.keys.push_back(key), quads.corners.push_back(corners);
  return quads;
}

/// Numbers of nodes in the middle of edges and quadrilaterals.
class NodeNumbers {
 public:
  NodeNumbers(const SecondOrder& second, const EdgeNumbers& edges, const Quads& quads)
      : second_(second), edges_(edges), quads_(quads) {}

  std::int32_t edge(std::int32_t a, std::int32_t b) const {
    const std::int32_t number = edges_(a, b);
    if (number < 0) throw InvalidInput("quadratic elements: a boundary facet is no element's side");
    return second_.first_edge_node + number;
  }
  std::int32_t quad(const QuadKey& corners) const {
    return second_.first_quad_node + static_cast<std::int32_t>(quads_.find(key_of(corners)));
  }

 private:
  const SecondOrder& second_;
  const EdgeNumbers& edges_;
  const Quads& quads_;
};

void add_lists(MixedMesh& mesh, const NodeNumbers& node) {
  mesh.tetrahedron_nodes.resize(mesh.tetrahedra.size());
  core::parallel_for(mesh.tetrahedra.size(), node_grain, [&](std::size_t i) {
    const geometry::Tetrahedron& t = mesh.tetrahedra[i];
    for (std::size_t e = 0; e < 6; ++e)
      mesh.tetrahedron_nodes[i][e] = node.edge(t[tetrahedron_edges[e][0]], t[tetrahedron_edges[e][1]]);
  });
  mesh.prism_nodes.resize(mesh.prisms.size());
  core::parallel_for(mesh.prisms.size(), node_grain, [&](std::size_t i) {
    const geometry::Prism& p = mesh.prisms[i];
    for (std::size_t e = 0; e < 9; ++e)
      mesh.prism_nodes[i][e] = node.edge(p[prism_edges[e][0]], p[prism_edges[e][1]]);
    for (std::size_t q = 0; q < 3; ++q) mesh.prism_nodes[i][9 + q] = node.quad(side_of(p, q));
  });
  for (const geometry::Triangle& t : mesh.triangles)
    mesh.triangle_nodes.push_back({node.edge(t[0], t[1]), node.edge(t[1], t[2]), node.edge(t[2], t[0])});
  for (const geometry::Quad& q : mesh.quads)
    mesh.quad_nodes.push_back({node.edge(q[0], q[1]), node.edge(q[1], q[2]), node.edge(q[2], q[3]),
                               node.edge(q[3], q[0]), node.quad(q)});
}

}  // namespace

EdgeNumbers::EdgeNumbers(const MixedMesh& mesh) {
  std::vector<std::size_t> first(mesh.points.size() + 1, 0);
  for_each_edge(
      mesh, [&](std::int32_t a, std::int32_t b) { ++first[static_cast<std::size_t>(std::min(a, b)) + 1]; });
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::int32_t> higher(first.back());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for_each_edge(mesh, [&](std::int32_t a, std::int32_t b) {
    higher[next[static_cast<std::size_t>(std::min(a, b))]++] = std::max(a, b);
  });
  std::vector<std::size_t> kept(mesh.points.size());
  core::parallel_for(kept.size(), node_grain, [&](std::size_t i) {
    const auto begin = higher.begin() + static_cast<std::ptrdiff_t>(first[i]),
               end = higher.begin() + static_cast<std::ptrdiff_t>(first[i + 1]);
    std::sort(begin, end);
    kept[i] = static_cast<std::size_t>(std::unique(begin, end) - begin);
  });
  first_.assign(mesh.points.size() + 1, 0);
  for (std::size_t i = 0; i < kept.size(); ++i) first_[i + 1] = first_[i] + kept[i];
  higher_.resize(first_.back());
  for (std::size_t i = 0; i < kept.size(); ++i)
    std::copy_n(higher.begin() + static_cast<std::ptrdiff_t>(first[i]), kept[i],
                higher_.begin() + static_cast<std::ptrdiff_t>(first_[i]));
}

std::int32_t EdgeNumbers::operator()(std::int32_t a, std::int32_t b) const {
  const auto low = static_cast<std::size_t>(std::min(a, b));
  const auto begin = higher_.begin() + static_cast<std::ptrdiff_t>(first_[low]),
             end = higher_.begin() + static_cast<std::ptrdiff_t>(first_[low + 1]);
  const auto found = std::lower_bound(begin, end, std::max(a, b));
  if (found == end || *found != std::max(a, b)) return -1;
  return static_cast<std::int32_t>(found - higher_.begin());
}

std::array<std::int32_t, 2> EdgeNumbers::ends(std::int32_t edge) const {
  const auto low =
      std::upper_bound(first_.begin(), first_.end(), static_cast<std::size_t>(edge)) - first_.begin() - 1;
  return {static_cast<std::int32_t>(low), higher_[static_cast<std::size_t>(edge)]};
}

SecondOrder with_straight_nodes(const MixedMesh& linear, const EdgeNumbers& edges,
                                const core::TaskContext& task) {
  const Quads quads = quads_of(linear);
  const std::size_t nodes = linear.points.size() + edges.size() + quads.keys.size();
  if (nodes > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw ResourceError("quadratic elements: " + std::to_string(nodes) +
                        " nodes are more than a mesh can number; mesh with longer edges");
  SecondOrder second;
  second.mesh = linear;
  second.first_edge_node = static_cast<std::int32_t>(linear.points.size());
  second.first_quad_node = second.first_edge_node + static_cast<std::int32_t>(edges.size());
  second.mesh.points.resize(nodes);
  task.throw_if_cancelled();
  core::parallel_for(edges.size(), node_grain, [&](std::size_t e) {
    const auto [a, b] = edges.ends(static_cast<std::int32_t>(e));
    second.mesh.points[linear.points.size() + e] = 0.5 * (at(linear, a) + at(linear, b));
  });
  const NodeNumbers numbers(second, edges, quads);
  second.quad_edges.resize(quads.keys.size());
  core::parallel_for(quads.keys.size(), node_grain, [&](std::size_t i) {
    const auto& [a, b, c, d] = quads.corners[i];
    second.mesh.points[static_cast<std::size_t>(second.first_quad_node) + i] =
        0.25 * ((at(linear, a) + at(linear, c)) + (at(linear, b) + at(linear, d)));
    second.quad_edges[i] = {numbers.edge(a, b), numbers.edge(b, c), numbers.edge(c, d), numbers.edge(d, a)};
  });
  task.throw_if_cancelled();
  add_lists(second.mesh, numbers);
  return second;
}

}  // namespace ostia::meshing
