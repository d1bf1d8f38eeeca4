#pragma once
/// \file The nodes of the second order of a linear mesh: which there are, and which of them follow the wall.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// A number for each edge of the elements, by the lower and then the higher end.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(const geometry::MixedMesh& mesh);
  std::size_t size() const { return higher_.size(); }
  /// -1 for no edge of an element.
  std::int32_t operator()(std::int32_t a, std::int32_t b) const;
  std::array<std::int32_t, 2> ends(std::int32_t edge) const;

 private:
  std::vector<std::size_t> first_;    // of each point: where its edges to higher points begin
  std::vector<std::int32_t> higher_;  // ascending for each
};

/// Adds the second-order nodes to the mesh's lists and puts them on straight edges: first those of the edges,
/// then those of the prisms' quadrilaterals. Throws InvalidInput for facets that are no element's side.
struct SecondOrder {
  geometry::MixedMesh mesh;
  std::int32_t first_edge_node = 0, first_quad_node = 0;
  /// The four edge nodes of each quadrilateral's node.
  std::vector<std::array<std::int32_t, 4>> quad_edges;
};
SecondOrder with_straight_nodes(const geometry::MixedMesh& linear, const EdgeNumbers& edges,
                                const core::TaskContext& task);

/// A node in the middle of an edge (or a quadrilateral) of the wall.
struct WallNode {
  std::int32_t node = -1;
  geometry::Vec3 straight = geometry::Vec3::Zero();
  geometry::Vec3 normal = geometry::Vec3::Zero();      ///< of the wall, unit, outward
  geometry::Vec3 cap_normal = geometry::Vec3::Zero();  ///< zero away from rings; across the edge
  double length = 0.0;                                 ///< of the edge, mm
};
std::vector<WallNode> wall_nodes(const SecondOrder& second);

/// A node inside the layers, or on their inner surface, under one of the wall.
struct LayerNode {
  std::int32_t node = -1;
  std::int32_t wall_node = -1;  ///< index into the wall's nodes
  double depth = 0.0;           ///< from the wall's node, mm
  double whole = 0.0;           ///< of all layers there, mm
};
/// Follows the columns of prisms from the wall's triangles inward.
std::vector<LayerNode> layer_nodes(const SecondOrder& second, const EdgeNumbers& edges,
                                   const std::vector<WallNode>& wall);

}  // namespace ostia::meshing
