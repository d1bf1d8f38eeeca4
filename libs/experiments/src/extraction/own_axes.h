#pragma once
/// \file The vessels of a tree, each with the stretch that is its own.

#include "ostia/geometry/vessel_tree.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ostia::experiments {

/// From the parent's axis (or the root) to the end.
struct OwnAxis {
  std::int32_t vessel = 0;
  std::string name;
  double from_mm = 0.0;  ///< where it begins on the vessel's whole axis
  std::vector<geometry::Vec3> points;
  std::vector<double> radius_mm;
};
std::vector<OwnAxis> own_axes(const geometry::VesselTree& tree);

struct NearestAxis {
  std::size_t axis = 0;  ///< index
  double s_mm = 0.0;     ///< along the own stretch
  double away_mm = 0.0, radius_mm = 0.0;
};
/// Of all axes the nearest, the first of equals. There is one at least.
NearestAxis nearest_axis(const std::vector<OwnAxis>& axes, const geometry::Vec3& place);

}  // namespace ostia::experiments
