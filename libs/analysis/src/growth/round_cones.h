#pragma once
/// \file Vessels as round cones: the balls whose centres and radii run evenly from one end to the other.

#include "ostia/geometry/vessel_graph.h"

#include <optional>

namespace ostia::analysis {

struct RoundCone {
  geometry::Vec3 from, to;
  double radius_from = 0.0, radius_to = 0.0;
};
RoundCone round_cone(const geometry::VesselGraph& graph, std::int32_t edge);

/// Where the balls of two cones reach furthest into each other.
struct ConeContact {
  double depth = 0.0;       ///< r + r' - distance of the two centres, > 0
  double s = 0.0, t = 0.0;  ///< where the centres are on either cone, 0 to 1
  geometry::Vec3 place;     ///< the middle of the overlap
};
/// None: the two solids, as unions of their balls, do not meet; this is exact. Distance less radii is a
/// convex function of (s, t): for each s the best t is in closed form, the best s by golden sections.
std::optional<ConeContact> contact(const RoundCone& a, const RoundCone& b);

}  // namespace ostia::analysis
