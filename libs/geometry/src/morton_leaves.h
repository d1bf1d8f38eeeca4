#pragma once
/// \file Boxes along a space-filling curve, in leaves of equal size: quicker to make than a Bvh.

#include "bvh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ostia::geometry::detail {

/// Half the size of a BvhBox. Boxes that overlap still do so when each corner goes through one and the same
/// ascending function (UnitCube), whatever its rounding; boxes that do not may then touch.
struct FloatBox {
  float lower[3];
  float upper[3];

  static FloatBox nothing() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    return {{inf, inf, inf}, {-inf, -inf, -inf}};
  }
  void extend(const FloatBox& other) {
    for (int a = 0; a < 3; ++a) {
      lower[a] = other.lower[a] < lower[a] ? other.lower[a] : lower[a];
      upper[a] = other.upper[a] > upper[a] ? other.upper[a] : upper[a];
    }
  }
  bool overlaps(const FloatBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
  double half_area() const {
    const double x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
  }
};

/// Maps what lies within finite bounds to [-1, 1] along each axis, ascending.
class UnitCube {
 public:
  explicit UnitCube(const BvhBox& bounds);
  FloatBox operator()(const BvhBox& box) const;

 private:
  double middle_[3], factor_[3];
};

/// The boxes of a leaf's items side by side, so that one box is tested against all of them at once.
struct LeafBoxes {
  float lower[3][8];
  float upper[3][8];

  void set(std::size_t item, const FloatBox& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a][item] = box.lower[a];
      upper[a][item] = box.upper[a];
    }
  }
  FloatBox box(std::size_t item) const {
    return {{lower[0][item], lower[1][item], lower[2][item]},
            {upper[0][item], upper[1][item], upper[2][item]}};
  }
  /// A bit for each item whose box overlaps this one.
  unsigned overlapping(const FloatBox& other) const {
    std::int32_t hit[8];
    for (std::size_t i = 0; i < 8; ++i)
      hit[i] = (lower[0][i] <= other.upper[0]) & (other.lower[0] <= upper[0][i]) &
               (lower[1][i] <= other.upper[1]) & (other.lower[1] <= upper[1][i]) &
               (lower[2][i] <= other.upper[2]) & (other.lower[2] <= upper[2][i]);
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) bits |= static_cast<unsigned>(hit[i]) << i;
    return bits;
  }
};

/// A complete binary tree over leaves of eight items each (the last may have fewer).
struct MortonLeaves {
  static constexpr std::size_t per_leaf = 8;

  std::vector<std::int32_t> order;            ///< items, leaf by leaf
  std::vector<LeafBoxes> boxes;               ///< of each leaf's items; empty ones where it has fewer
  std::vector<std::vector<FloatBox>> levels;  ///< [0]: the leaves; [k][i]: of [k - 1][2 i] and [2 i + 1]

  std::size_t leaves() const { return boxes.size(); }
};

/// Leaves in Morton order. Where items that follow each other lie together, as they do in most meshes, the
/// leaves are eight in a row each, and only these are put in order; else the items are. The boxes are a
/// UnitCube's; none gives no levels. The same input gives the same leaves. On all cores.
MortonLeaves morton_leaves(const std::vector<FloatBox>& boxes);

/// A node of the tree.
struct LeafNode {
  std::size_t level = 0, index = 0;

  std::size_t begin() const { return index << level; }
  std::size_t end() const { return (index + 1) << level; }
  LeafNode child(std::size_t which) const { return {level - 1, 2 * index + which}; }
};

/// Calls visit(leaf, other) for the leaves of `a` with those of `b` whose boxes overlap, as long as
/// `enter(a, b)` allows it for the nodes above them.
template <class Enter, class Visit>
void for_leaf_pairs(const MortonLeaves& tree, LeafNode a, LeafNode b, const Enter& enter,
                    const Visit& visit) {
  if (!tree.levels[a.level][a.index].overlaps(tree.levels[b.level][b.index]) || !enter(a, b)) return;
  if (a.level == 0 && b.level == 0) return visit(a.index, b.index);
  for (std::size_t which = 0; which < 2; ++which) {
    const LeafNode next = (a.level >= b.level ? a : b).child(which);
    if (next.index >= tree.levels[next.level].size()) continue;
    if (a.level >= b.level)
      for_leaf_pairs(tree, next, b, enter, visit);
    else
      for_leaf_pairs(tree, a, next, enter, visit);
  }
}

/// The same for the leaves of `a` with each other, and each with itself.
template <class Enter, class Visit>
void for_leaf_pairs(const MortonLeaves& tree, LeafNode a, const Enter& enter, const Visit& visit) {
  if (!enter(a, a)) return;
  if (a.level == 0) return visit(a.index, a.index);
  for_leaf_pairs(tree, a.child(0), enter, visit);
  if (a.child(1).index >= tree.levels[a.level - 1].size()) return;
  for_leaf_pairs(tree, a.child(0), a.child(1), enter, visit);
  for_leaf_pairs(tree, a.child(1), enter, visit);
}

/// The same for the leaves of `a` with all later ones below `below`.
template <class Enter, class Visit>
void for_later_pairs(const MortonLeaves& tree, LeafNode a, LeafNode below, const Enter& enter,
                     const Visit& visit) {
  if (below.end() <= a.end()) return;
  if (below.begin() >= a.end()) return for_leaf_pairs(tree, a, below, enter, visit);
  for (std::size_t which = 0; which < 2; ++which) {
    const LeafNode next = below.child(which);
    if (next.index < tree.levels[next.level].size()) for_later_pairs(tree, a, next, enter, visit);
  }
}

}  // namespace ostia::geometry::detail
