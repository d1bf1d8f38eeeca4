#pragma once
/// \file A bounding-volume hierarchy over boxes; the triangle trees of this library share it.

#include "ostia/geometry/vec.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace ostia::geometry::detail {

/// Plain corners: quicker to grow and test than Eigen's aligned box.
struct BvhBox {
  double lower[3];
  double upper[3];

  static BvhBox nothing() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }
  // Axis by axis in words, not in a loop: the compiler then keeps a box that grows in registers.
  void extend(const double* point) {
    extend_axis(0, point[0], point[0]);
    extend_axis(1, point[1], point[1]);
    extend_axis(2, point[2], point[2]);
  }
  void extend(const BvhBox& other) {
    extend_axis(0, other.lower[0], other.upper[0]);
    extend_axis(1, other.lower[1], other.upper[1]);
    extend_axis(2, other.lower[2], other.upper[2]);
  }
  void extend_axis(int a, double low, double high) {
    lower[a] = low < lower[a] ? low : lower[a];
    upper[a] = high > upper[a] ? high : upper[a];
  }
  double half_area() const;
  bool overlaps(const BvhBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  double squared_distance(const Vec3& point) const {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double below = lower[a] - point[a];
      const double above = point[a] - upper[a];
      double gap = below > above ? below : above;
      gap = gap > 0.0 ? gap : 0.0;  // a choice and no branch: on which side of a box a point lies is chance
      sum += gap * gap;
    }
    return sum;
  }
};

/// Nodes in depth-first order: an inner node's left child follows it, its right one stands at `next`.
struct BvhNode {
  BvhBox box;
  std::int32_t next = 0;   ///< inner node: right child; leaf: first place in `order`
  std::int32_t count = 0;  ///< 0 for an inner node, else the items of the leaf
};

/// Deeper than any tree that build_bvh makes: traversals keep stacks of this size.
inline constexpr int bvh_stack_size = 128;

struct Bvh {
  std::vector<BvhNode> nodes;
  std::vector<std::int32_t> order;  ///< items, leaf by leaf
};

/// Splits by the surface-area heuristic in bins (Wald 2007). `boxes` must be finite; none gives no nodes.
/// The same input gives the same tree. On all cores; from within a parallel loop too.
Bvh build_bvh(const std::vector<BvhBox>& boxes, int leaf_size = 4);

}  // namespace ostia::geometry::detail
