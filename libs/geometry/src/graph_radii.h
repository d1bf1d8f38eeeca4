#pragma once
/// \file Radii that a network's file does not have.

#include "ostia/geometry/vessel_graph.h"

namespace ostia::geometry {

/// Greater than 0 and finite.
bool known_radius(double radius);
/// One of its radii is not known.
bool lacks_radius(const GraphEdge& edge);

/// The radii that are known at each point.
struct PointRadii {
  explicit PointRadii(std::size_t points) : sum(points, 0.0), count(points, 0) {}
  void add(std::int32_t point, double radius) {  ///< nothing where it is not known
    if (!known_radius(radius)) return;
    sum[static_cast<std::size_t>(point)] += radius;
    ++count[static_cast<std::size_t>(point)];
  }
  std::vector<double> sum;
  std::vector<std::int32_t> count;
};

/// Radii that are missing, zero or negative, from their neighbours. Round by round: each end of a segment
/// takes the mean of the radii known at its point, or else the one of its segment's other end, until nothing
/// changes. `spare` counts at points where no segment's radius is known at first. The graph's indices must be
/// in range.
void fill_radii(VesselGraph& graph, const PointRadii& spare, const core::TaskContext& task);

}  // namespace ostia::geometry
