#pragma once
/// \file A hierarchy of boxes over the segments of a tree of vessels.

#include "growth/round_cones.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::analysis {

/// Boxes in single precision, rounded outwards. Halved at the median of the longest side, so its depth is
/// bounded by the number of halvings. The same graph gives the same tree.
class ConeTree {
 public:
  struct Box {
    std::array<float, 3> lower, upper;
    bool meets(const Box& other) const {
      for (std::size_t a = 0; a < 3; ++a)
        if (lower[a] > other.upper[a] || other.lower[a] > upper[a]) return false;
      return true;
    }
  };
  explicit ConeTree(const geometry::VesselGraph& graph);
  const Box& box(std::int32_t edge) const { return boxes_[static_cast<std::size_t>(edge)]; }
  /// All edges of higher index whose box meets that of `edge`, appended.
  void partners(std::int32_t edge, std::vector<std::int32_t>& found) const;

 private:
  struct Node {
    Box box;
    std::int32_t next = 0;     ///< inner node: its right child; leaf: first place in `order_`
    std::int32_t count = 0;    ///< 0: an inner node, whose left child follows it
    std::int32_t highest = 0;  ///< index of an edge below it
  };
  void build();
  Node node_of(std::size_t first, std::size_t last) const;
  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace ostia::analysis
