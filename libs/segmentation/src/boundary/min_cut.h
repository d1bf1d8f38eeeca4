#pragma once
/// \file Minimum cut of a graph with two terminals (Boykov and Kolmogorov 2004): two search trees that are
/// kept and repaired between augmentations.

#include "ostia/core/task_context.h"

#include <cstdint>
#include <vector>

namespace ostia::segmentation {

class MinCut {
 public:
  explicit MinCut(std::size_t nodes) : nodes_(nodes) {}
  /// Capacities from the source to a node (positive) or from it to the sink (negative); they add up.
  void add_terminal(std::size_t node, float capacity) { nodes_[node].excess += capacity; }
  /// An arc and its reverse.
  void add_arc(std::size_t from, std::size_t to, float capacity, float reverse);
  void reserve_arcs(std::size_t pairs) { arcs_.reserve(2 * pairs); }
  /// Deterministic. Throws Cancelled.
  void solve(const core::TaskContext& task = core::no_task());
  /// After solve: whether the node is on the source's side of a minimum cut (the smallest such side).
  bool on_source_side(std::size_t node) const { return nodes_[node].tree == Tree::source; }

 private:
  static constexpr std::int32_t none = -1, terminal = -2, orphan = -3;
  enum class Tree : std::uint8_t { free, source, sink };
  struct Arc {
    std::int32_t head = 0, next = none;
    float capacity = 0.0F;
  };
  struct Node {
    std::int32_t first = none;
    std::int32_t parent = none;  ///< arc from this node to its parent, or one of the constants above
    std::int32_t next_active = none;
    std::int32_t stamp = 0, distance = 0;
    float excess = 0.0F;
    Tree tree = Tree::free;
  };
  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;
  std::int32_t queue_first_ = none, queue_last_ = none;
  std::vector<std::int32_t> orphans_;
  std::int32_t time_ = 0;

  void start();
  void activate(std::int32_t node);
  std::int32_t next_active();
  std::int32_t grow(std::int32_t node);
  void augment(std::int32_t middle);
  void adopt(std::int32_t node);
  void make_orphan(std::int32_t node);
  std::int32_t distance_to_root(std::int32_t node);
  float usable(std::int32_t arc, Tree tree) const {
    return arcs_[tree == Tree::source ? arc : arc ^ 1].capacity;
  }
};

}  // namespace ostia::segmentation
