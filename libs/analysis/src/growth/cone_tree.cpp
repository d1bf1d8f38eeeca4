#include "growth/cone_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::analysis {
namespace {

constexpr std::size_t cones_per_leaf = 4;

ConeTree::Box box_of(const RoundCone& cone) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  ConeTree::Box box{};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    box.lower[at] = std::nextafter(
        static_cast<float>(std::min(cone.from[a] - cone.radius_from, cone.to[a] - cone.radius_to)),
        -infinity);
    box.upper[at] = std::nextafter(
        static_cast<float>(std::max(cone.from[a] + cone.radius_from, cone.to[a] + cone.radius_to)), infinity);
  }
  return box;
}

}  // namespace

ConeTree::ConeTree(const geometry::VesselGraph& graph) {
  boxes_.reserve(graph.edges.size());
  order_.reserve(graph.edges.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    boxes_.push_back(box_of(round_cone(graph, static_cast<std::int32_t>(e))));
    order_.push_back(static_cast<std::int32_t>(e));
  }
  if (!boxes_.empty()) build();
}

ConeTree::Node ConeTree::node_of(std::size_t first, std::size_t last) const {
  Node node;
  node.box = box(order_[first]);
  node.highest = order_[first];
  for (std::size_t i = first + 1; i < last; ++i) {
    const Box& more = box(order_[i]);
    node.highest = std::max(node.highest, order_[i]);
    for (std::size_t a = 0; a < 3; ++a) {
      node.box.lower[a] = std::min(node.box.lower[a], more.lower[a]);
      node.box.upper[a] = std::max(node.box.upper[a], more.upper[a]);
    }
  }
  return node;
}

void ConeTree::build() {
  struct Part {
    std::size_t first, last;
    std::int32_t left_of;  ///< the node whose right child this is; -1: none
  };
  std::vector<Part> parts{{0, order_.size(), -1}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    const auto index = static_cast<std::int32_t>(nodes_.size());
    if (part.left_of >= 0) nodes_[static_cast<std::size_t>(part.left_of)].next = index;
    nodes_.push_back(node_of(part.first, part.last));
    Node& node = nodes_.back();
    if (part.last - part.first <= cones_per_leaf) {
      node.next = static_cast<std::int32_t>(part.first);
      node.count = static_cast<std::int32_t>(part.last - part.first);
      continue;
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
      if (node.box.upper[a] - node.box.lower[a] > node.box.upper[axis] - node.box.lower[axis]) axis = a;
    const std::size_t middle = part.first + (part.last - part.first) / 2;
    const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(part.first), at(middle), at(part.last), [&](std::int32_t a, std::int32_t b) {
      const float x = box(a).lower[axis] + box(a).upper[axis], y = box(b).lower[axis] + box(b).upper[axis];
      return x < y || (x == y && a < b);
    });
    parts.push_back({middle, part.last, index});
    parts.push_back({part.first, middle, -1});
  }
}

void ConeTree::partners(std::int32_t edge, std::vector<std::int32_t>& found) const {
  const Box& own = box(edge);
  std::array<std::int32_t, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::int32_t index = stack[--depth];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.highest <= edge || !node.box.meets(own)) continue;
    if (node.count == 0) {
      stack[depth++] = node.next;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::int32_t i = node.next; i < node.next + node.count; ++i) {
      const std::int32_t other = order_[static_cast<std::size_t>(i)];
      if (other > edge && box(other).meets(own)) found.push_back(other);
    }
  }
}

}  // namespace ostia::analysis
