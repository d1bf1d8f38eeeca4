#pragma once
/// \file Boxes along a space-filling curve, in leaves of equal size: quicker to make than a Bvh.

#include "bvh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::geometry::detail {

/// A complete binary tree over leaves of eight items each (the last may have fewer) in Morton order.
struct MortonLeaves {
  static constexpr std::size_t per_leaf = 8;

  std::vector<std::int32_t> order;          ///< items, leaf by leaf
  std::vector<std::vector<BvhBox>> levels;  ///< [0]: the leaves; [k][i]: of [k - 1][2 i] and [2 i + 1]

  std::size_t leaves() const { return levels.empty() ? 0 : levels[0].size(); }
  std::size_t first(std::size_t leaf) const { return leaf * per_leaf; }
  std::size_t last(std::size_t leaf) const {
    return first(leaf) + per_leaf < order.size() ? first(leaf) + per_leaf : order.size();
  }
};

/// `boxes` must be finite; none gives no levels. The same input gives the same leaves. On all cores.
MortonLeaves morton_leaves(const std::vector<BvhBox>& boxes);

/// Calls visit(other) for `leaf` and each later leaf whose box overlaps its own, as long as `enter(level,
/// index)` allows the subtree.
template <class Enter, class Visit>
void for_later_leaves(const MortonLeaves& tree, std::size_t leaf, const Enter& enter, const Visit& visit) {
  struct Node {
    std::size_t level, index;
  };
  Node stack[64];
  std::size_t size = 0;
  stack[size++] = {tree.levels.size() - 1, 0};
  const BvhBox& box = tree.levels[0][leaf];
  while (size > 0) {
    const Node node = stack[--size];
    if (((node.index + 1) << node.level) <= leaf || !tree.levels[node.level][node.index].overlaps(box) ||
        !enter(node.level, node.index))
      continue;
    if (node.level == 0) {
      visit(node.index);
      continue;
    }
    const std::size_t left = 2 * node.index;
    if (left + 1 < tree.levels[node.level - 1].size()) stack[size++] = {node.level - 1, left + 1};
    stack[size++] = {node.level - 1, left};
  }
}

}  // namespace ostia::geometry::detail
