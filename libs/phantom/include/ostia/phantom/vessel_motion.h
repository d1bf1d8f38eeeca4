#pragma once
/// \file How far and how fast the arteries of a beating phantom go.

#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heartbeat.h"

#include <string>
#include <vector>

namespace ostia::phantom {

/// Of a vessel's axis over one beat, at points about 1 mm apart.
struct VesselMotion {
  std::string vessel;            ///< "RCA", "LM", "LAD", "LCX"; the left main ends where the LAD begins
  double displacement_mm = 0.0;  ///< peak to peak (between a point's two places farthest apart), mean of
                                 ///< the points
  double largest_displacement_mm = 0.0;  ///< of a point
  double speed_mm_per_s = 0.0;           ///< mean of the points, at the fastest moment
  double largest_speed_mm_per_s = 0.0;   ///< of a point
  /// Mean of the points' distances from their places in the template, at 200 equal phases from 0 on.
  std::vector<double> distance_mm;
};
std::vector<VesselMotion> vessel_motion(const CoronaryTree& tree, const Heartbeat& beat);

/// Points on all axes about 1 mm apart, vessel by vessel in the tree's order.
std::vector<Vec3> axis_points(const CoronaryTree& tree);

}  // namespace ostia::phantom
