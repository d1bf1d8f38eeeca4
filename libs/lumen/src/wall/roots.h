#pragma once
// Where a field crosses zero on grid edges, many at once.

#include "wall/job.h"

namespace ostia::lumen {

/// A grid edge whose ends lie on different sides of the wall, with the values there.
struct WallEdge {
  GridIndex node{0, 0, 0};
  int axis = 0;
  double from = 0.0, to = 0.0;
};

/// The fraction of each edge at which the field is zero, kept node_clearance off the ends. Each depends on
/// its own edge alone.
std::vector<double> roots(WallJob& job, const std::vector<WallEdge>& edges);

}  // namespace ostia::lumen
