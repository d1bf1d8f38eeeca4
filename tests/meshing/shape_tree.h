#pragma once
/// \file The vessel tree of an analytic shape whose branches begin on the axis, or at the end, of an earlier
/// tube.

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/vessel_tree.h"

#include <algorithm>
#include <map>

namespace ostia::meshing {

inline geometry::VesselTree tree_of(const geometry::AnalyticShape& shape) {
  using geometry::Vec3;
  constexpr double near_mm = 0.2;
  geometry::VesselTree tree;
  auto node_at = [&](const Vec3& p) {
    for (const geometry::TreeNode& n : tree.nodes)
      if ((n.position - p).norm() < near_mm) return n.id;
    tree.nodes.push_back({static_cast<std::int32_t>(tree.nodes.size()) + 10, p});
    return tree.nodes.back().id;
  };
  std::map<std::int32_t, std::vector<std::int32_t>> path_to;  // segments from the root to each node
  for (std::size_t i = 0; i < shape.tubes.size(); ++i) {
    const geometry::Centerline& axis = shape.tubes[i].axis;
    std::vector<std::size_t> cuts{0, axis.size() - 1};
    for (std::size_t j = i + 1; j < shape.tubes.size(); ++j) {
      const Vec3& start = shape.tubes[j].axis.points.front();
      const auto distance = [&](std::size_t k) { return (axis.points[k] - start).norm(); };
      std::size_t best = 0;
      for (std::size_t k = 1; k < axis.size(); ++k)
        if (distance(k) < distance(best)) best = k;
      if (distance(best) < near_mm) cuts.push_back(best);
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
      geometry::TreeSegment segment;
      segment.id = static_cast<std::int32_t>(tree.segments.size()) + 100;
      segment.from = node_at(axis.points[cuts[c]]);
      segment.to = node_at(axis.points[cuts[c + 1]]);
      const auto first = static_cast<std::ptrdiff_t>(cuts[c]),
                 last = static_cast<std::ptrdiff_t>(cuts[c + 1]) + 1;
      segment.axis.points.assign(axis.points.begin() + first, axis.points.begin() + last);
      segment.axis.radius.assign(axis.radius.begin() + first, axis.radius.begin() + last);
      segment.axis.points.front() = geometry::node(tree, segment.from).position;
      geometry::complete(segment.axis);
      path_to[segment.to] = path_to[segment.from];
      path_to[segment.to].push_back(segment.id);
      tree.segments.push_back(std::move(segment));
    }
  }
  // Only tubes that run to an end carry a vessel; a parent that splits there is part of its children's.
  const std::vector<std::int32_t> ends = geometry::ends(tree);
  for (std::size_t i = 0; i < shape.tubes.size(); ++i) {
    const std::int32_t end = node_at(shape.tubes[i].axis.points.back());
    if (std::find(ends.begin(), ends.end(), end) != ends.end())
      tree.vessels.push_back({static_cast<std::int32_t>(i) + 1, shape.tubes[i].name, path_to[end]});
  }
  return tree;
}

}  // namespace ostia::meshing
