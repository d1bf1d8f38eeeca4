#pragma once
/// \file Which overlaps of vessels are those of a bend or a fork.

#include "growth/round_cones.h"

#include "ostia/analysis/graph_overlaps.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

/// Keeps references to the graph and to the edge that arrives at each point (-1: a root; the first where
/// several do): both may grow.
class JointRule {
 public:
  JointRule(const geometry::VesselGraph& graph, const std::vector<std::int32_t>& arriving,
            const OverlapOptions& options)
      : graph_(graph), arriving_(arriving), options_(options) {}
  /// They share a point, or the way along the vessel between the contacts is short (see OverlapOptions).
  bool covers(std::int32_t a, std::int32_t b, const ConeContact& hit) const;
  bool share_a_point(std::int32_t a, std::int32_t b) const;

 private:
  /// A point on the way from a segment towards the root, and how long the way there is.
  struct Station {
    std::int32_t point;
    double way;
  };
  const geometry::GraphEdge& edge_at(std::int32_t edge) const {
    return graph_.edges[static_cast<std::size_t>(edge)];
  }
  double length(std::int32_t edge) const;
  std::vector<Station> way_up(std::int32_t edge, double at, double reach) const;

  const geometry::VesselGraph& graph_;
  const std::vector<std::int32_t>& arriving_;
  OverlapOptions options_;
};

}  // namespace ostia::analysis
