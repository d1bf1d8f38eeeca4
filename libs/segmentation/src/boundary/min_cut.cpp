#include "boundary/min_cut.h"

#include <algorithm>
#include <limits>

namespace ostia::segmentation {

void MinCut::add_arc(std::size_t from, std::size_t to, float capacity, float reverse) {
  const auto arc = static_cast<std::int32_t>(arcs_.size());
  arcs_.push_back({static_cast<std::int32_t>(to), nodes_[from].first, capacity});
  arcs_.push_back({static_cast<std::int32_t>(from), nodes_[to].first, reverse});
  nodes_[from].first = arc;
  nodes_[to].first = arc + 1;
}

void MinCut::start() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    node.next_active = none;
    if (node.excess == 0.0F) continue;
    node.tree = node.excess > 0.0F ? Tree::source : Tree::sink;
    node.parent = terminal;
    node.distance = 1;
    activate(static_cast<std::int32_t>(n));
  }
}

// A node in the queue points to the next one, the last to itself.
void MinCut::activate(std::int32_t node) {
  if (nodes_[node].next_active != none) return;
  if (queue_last_ == none) {
    queue_first_ = node;
  } else {
    nodes_[queue_last_].next_active = node;
  }
  queue_last_ = node;
  nodes_[node].next_active = node;
}

std::int32_t MinCut::next_active() {
  while (queue_first_ != none) {
    const std::int32_t node = queue_first_;
    const std::int32_t next = nodes_[node].next_active;
    queue_first_ = next == node ? none : next;
    if (queue_first_ == none) queue_last_ = none;
    nodes_[node].next_active = none;
    if (nodes_[node].tree != Tree::free) return node;
  }
  return none;
}

/// The arc, directed from the source's tree to the sink's, where the node's tree meets the other; none
/// when the node has grown as far as it can.
std::int32_t MinCut::grow(std::int32_t node) {
  const Tree tree = nodes_[node].tree;
  for (std::int32_t arc = nodes_[node].first; arc != none; arc = arcs_[arc].next) {
    if (usable(arc, tree) <= 0.0F) continue;
    Node& other = nodes_[arcs_[arc].head];
    if (other.tree == Tree::free) {
      other.tree = tree;
      other.parent = arc ^ 1;
      other.stamp = nodes_[node].stamp;
      other.distance = nodes_[node].distance + 1;
      activate(arcs_[arc].head);
    } else if (other.tree != tree) {
      return tree == Tree::source ? arc : arc ^ 1;
    } else if (other.stamp <= nodes_[node].stamp && other.distance > nodes_[node].distance + 1) {
      other.parent = arc ^ 1;  // a shorter way to the root
      other.stamp = nodes_[node].stamp;
      other.distance = nodes_[node].distance + 1;
    }
  }
  return none;
}

void MinCut::make_orphan(std::int32_t node) {
  nodes_[node].parent = orphan;
  orphans_.push_back(node);
}

void MinCut::augment(std::int32_t middle) {
  float flow = arcs_[middle].capacity;
  std::int32_t node = arcs_[middle ^ 1].head;
  for (; nodes_[node].parent != terminal; node = arcs_[nodes_[node].parent].head) {
    flow = std::min(flow, arcs_[nodes_[node].parent ^ 1].capacity);
  }
  flow = std::min(flow, nodes_[node].excess);
  node = arcs_[middle].head;
  for (; nodes_[node].parent != terminal; node = arcs_[nodes_[node].parent].head) {
    flow = std::min(flow, arcs_[nodes_[node].parent].capacity);
  }
  flow = std::min(flow, -nodes_[node].excess);

  arcs_[middle].capacity -= flow;
  arcs_[middle ^ 1].capacity += flow;
  for (node = arcs_[middle ^ 1].head; nodes_[node].parent != terminal;) {
    const std::int32_t up = nodes_[node].parent;  // flow comes down along its reverse
    arcs_[up].capacity += flow;
    arcs_[up ^ 1].capacity -= flow;
    if (arcs_[up ^ 1].capacity <= 0.0F) make_orphan(node);
    node = arcs_[up].head;
  }
  nodes_[node].excess -= flow;
  if (nodes_[node].excess <= 0.0F) make_orphan(node);
  for (node = arcs_[middle].head; nodes_[node].parent != terminal;) {
    const std::int32_t up = nodes_[node].parent;
    arcs_[up].capacity -= flow;
    arcs_[up ^ 1].capacity += flow;
    if (arcs_[up].capacity <= 0.0F) make_orphan(node);
    node = arcs_[up].head;
  }
  nodes_[node].excess += flow;
  if (nodes_[node].excess >= 0.0F) make_orphan(node);
}

/// Steps from a node to its root, or -1 when its line of parents ends in an orphan. Marks the line so that it
/// is not walked twice within one repair.
std::int32_t MinCut::distance_to_root(std::int32_t node) {
  std::int32_t steps = 0;
  std::int32_t at = node;
  for (;;) {
    Node& here = nodes_[at];
    if (here.stamp == time_) {
      steps += here.distance;
      break;
    }
    ++steps;
    if (here.parent == terminal) {
      here.stamp = time_;
      here.distance = 1;
      break;
    }
    if (here.parent == orphan || here.parent == none) return -1;
    at = arcs_[here.parent].head;
  }
  std::int32_t left = steps;
  for (at = node; nodes_[at].stamp != time_; at = arcs_[nodes_[at].parent].head) {
    nodes_[at].stamp = time_;
    nodes_[at].distance = left--;
  }
  return steps;
}

void MinCut::adopt(std::int32_t node) {
  const Tree tree = nodes_[node].tree;
  std::int32_t best_arc = none, best = std::numeric_limits<std::int32_t>::max();
  for (std::int32_t arc = nodes_[node].first; arc != none; arc = arcs_[arc].next) {
    if (usable(arc ^ 1, tree) <= 0.0F) continue;
    const std::int32_t head = arcs_[arc].head;
    if (nodes_[head].tree != tree || nodes_[head].parent == none) continue;
    const std::int32_t steps = distance_to_root(head);
    if (steps >= 0 && steps < best) {
      best = steps;
      best_arc = arc;
    }
  }
  if (best_arc != none) {
    nodes_[node].parent = best_arc;
    nodes_[node].stamp = time_;
    nodes_[node].distance = best + 1;
    return;
  }
  for (std::int32_t arc = nodes_[node].first; arc != none; arc = arcs_[arc].next) {
    const std::int32_t head = arcs_[arc].head;
    if (nodes_[head].tree != tree) continue;
    if (usable(arc ^ 1, tree) > 0.0F) activate(head);
    const std::int32_t up = nodes_[head].parent;
    if (up >= 0 && arcs_[up].head == node) make_orphan(head);
  }
  nodes_[node].tree = Tree::free;
  nodes_[node].parent = none;
}

void MinCut::solve(const core::TaskContext& task) {
  start();
  std::int32_t current = none;
  std::size_t rounds = 0;
  for (;;) {
    if (++rounds % 16384 == 0) task.throw_if_cancelled();
    std::int32_t node = current;
    if (node == none || nodes_[node].tree == Tree::free) node = next_active();
    if (node == none) break;
    const std::int32_t meeting = grow(node);
    current = none;
    if (meeting == none) continue;
    current = node;  // it may have more to grow
    ++time_;
    augment(meeting);
    for (std::size_t i = 0; i < orphans_.size(); ++i) adopt(orphans_[i]);
    orphans_.clear();
  }
}

}  // namespace ostia::segmentation
