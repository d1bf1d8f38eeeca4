#include "quadratic/nodes.h"

#include "ostia/geometry/faces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

/// Collects the wall's nodes, each once, in the order in which they are met.
class WallNodes {
 public:
  explicit WallNodes(const MixedMesh& mesh) : mesh_(mesh), index_(mesh.points.size(), -1) {}

  void add(std::int32_t node, const Vec3& area, double length) {
    std::int32_t& index = index_[static_cast<std::size_t>(node)];
    if (index < 0) {
      index = static_cast<std::int32_t>(nodes.size());
      nodes.push_back(
          {node, mesh_.points[static_cast<std::size_t>(node)], Vec3::Zero(), Vec3::Zero(), length});
    }
    nodes[static_cast<std::size_t>(index)].normal += area;
  }
  void add_cap(std::int32_t node, const Vec3& along, const Vec3& area) {
    const std::int32_t index = index_[static_cast<std::size_t>(node)];
    if (index < 0) return;  // inside the cap
    // A plane through the edge, even where the cap is not quite flat.
    Vec3 normal = area - along * (area.dot(along) / along.squaredNorm());
    nodes[static_cast<std::size_t>(index)].cap_normal = normal.normalized();
  }
  double edge(std::int32_t a, std::int32_t b) const { return step(a, b).norm(); }
  Vec3 step(std::int32_t a, std::int32_t b) const {
    return mesh_.points[static_cast<std::size_t>(b)] - mesh_.points[static_cast<std::size_t>(a)];
  }

  std::vector<WallNode> nodes;

 private:
  const MixedMesh& mesh_;
  std::vector<std::int32_t> index_;
};

using TriangleKey = std::array<std::int32_t, 3>;
TriangleKey triangle_key(TriangleKey corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The prisms on a triangle.
class PrismsOnTriangles {
 public:
  explicit PrismsOnTriangles(const MixedMesh& mesh) : mesh_(mesh) {
    entries_.reserve(2 * mesh.prisms.size());
    for (std::size_t i = 0; i < mesh.prisms.size(); ++i) {
      const geometry::Prism& p = mesh.prisms[i];
      entries_.push_back({triangle_key({p[0], p[1], p[2]}), static_cast<std::int32_t>(i)});
      entries_.push_back({triangle_key({p[3], p[4], p[5]}), static_cast<std::int32_t>(i)});
    }
    std::sort(entries_.begin(), entries_.end());
  }
  /// Another one than `last`; -1 for none.
  std::int32_t next(const TriangleKey& corners, std::int32_t last) const {
    const TriangleKey key = triangle_key(corners);
    auto found = std::lower_bound(entries_.begin(), entries_.end(), std::pair{key, std::int32_t{-1}});
    for (; found != entries_.end() && found->first == key; ++found)
      if (found->second != last) return found->second;
    return -1;
  }
  /// The corners across the prism, each opposite that of `corners`.
  TriangleKey across(const TriangleKey& corners, std::int32_t prism) const {
    const geometry::Prism& p = mesh_.prisms[static_cast<std::size_t>(prism)];
    TriangleKey opposite{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 6; ++k)
        if (p[k] == corners[i]) opposite[i] = p[(k + 3) % 6];
    return opposite;
  }

 private:
  const MixedMesh& mesh_;
  std::vector<std::pair<TriangleKey, std::int32_t>> entries_;
};

}  // namespace

std::vector<WallNode> wall_nodes(const SecondOrder& second) {
  const MixedMesh& mesh = second.mesh;
  WallNodes wall(mesh);
  const geometry::FacesByKind faces(mesh.faces);  // one that is not known is wall
  for (const bool caps : {false, true}) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (faces.cap(mesh.triangle_face_ids[i]) != caps) continue;
      const geometry::Triangle& t = mesh.triangles[i];
      const Vec3 area = wall.step(t[0], t[1]).cross(wall.step(t[0], t[2]));
      for (std::size_t e = 0; e < 3; ++e) {
        const std::int32_t a = t[e], b = t[(e + 1) % 3], node = mesh.triangle_nodes[i][e];
        if (caps)
          wall.add_cap(node, wall.step(a, b), area);
        else
          wall.add(node, area, wall.edge(a, b));
      }
    }
    for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
      if (faces.cap(mesh.quad_face_ids[i]) != caps) continue;
      const geometry::Quad& q = mesh.quads[i];
      const Vec3 area = wall.step(q[0], q[2]).cross(wall.step(q[1], q[3]));
      for (std::size_t e = 0; e < 4; ++e) {
        const std::int32_t a = q[e], b = q[(e + 1) % 4], node = mesh.quad_nodes[i][e];
        if (caps)
          wall.add_cap(node, wall.step(a, b), area);
        else
          wall.add(node, area, wall.edge(a, b));
      }
      if (!caps) wall.add(mesh.quad_nodes[i][4], area, wall.edge(q[0], q[2]));
    }
  }
  for (WallNode& node : wall.nodes) node.normal.normalize();
  return std::move(wall.nodes);
}

std::vector<LayerNode> layer_nodes(const SecondOrder& second, const EdgeNumbers& edges,
                                   const std::vector<WallNode>& wall) {
  const MixedMesh& mesh = second.mesh;
  if (mesh.prisms.empty()) return {};
  std::vector<std::int32_t> driver(mesh.points.size(), -1);  // each node's wall node
  for (std::size_t i = 0; i < wall.size(); ++i)
    driver[static_cast<std::size_t>(wall[i].node)] = static_cast<std::int32_t>(i);
  const PrismsOnTriangles prisms(mesh);
  const geometry::FacesByKind faces(mesh.faces);
  std::vector<LayerNode> nodes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (faces.cap(mesh.triangle_face_ids[i])) continue;
    std::array<std::vector<LayerNode>, 3> columns;
    std::array<double, 3> depth{};
    TriangleKey corners = mesh.triangles[i];
    std::array<std::int32_t, 3> above = mesh.triangle_nodes[i];
    for (std::int32_t prism = prisms.next(corners, -1); prism >= 0; prism = prisms.next(corners, prism)) {
      corners = prisms.across(corners, prism);
      for (std::size_t e = 0; e < 3; ++e) {
        const std::int32_t node = second.first_edge_node + edges(corners[e], corners[(e + 1) % 3]);
        depth[e] +=
            (mesh.points[static_cast<std::size_t>(node)] - mesh.points[static_cast<std::size_t>(above[e])])
                .norm();
        columns[e].push_back(
            {node, driver[static_cast<std::size_t>(mesh.triangle_nodes[i][e])], depth[e], 0.0});
        above[e] = node;
      }
    }
    for (std::size_t e = 0; e < 3; ++e)
      for (LayerNode& node : columns[e]) {
        std::int32_t& known = driver[static_cast<std::size_t>(node.node)];
        if (known >= 0) continue;  // of the neighbouring column, or on a wall itself
        known = node.wall_node;
        node.whole = depth[e];
        nodes.push_back(node);
      }
  }
  return nodes;
}

}  // namespace ostia::meshing
