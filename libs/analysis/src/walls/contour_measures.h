#pragma once
/// \file What a closed line in a plane measures.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::analysis {

using geometry::Vec2;

struct ContourMeasures {
  double area_mm2 = 0.0, perimeter_mm = 0.0;
  Vec2 centroid = Vec2::Zero();
  double least_width_mm = 0.0, largest_width_mm = 0.0;  ///< of two parallel tangents
};

/// Of a counter-clockwise line through at least three points, its last one joined to the first. Each side
/// counts as the circular arc whose curvature is the mean of those at its ends (of the circle through a point
/// and its neighbours): exact for circles, off by the fourth power of the points' distance for smooth lines.
ContourMeasures measures_of(const std::vector<Vec2>& line);

/// The convex hull, counter-clockwise, without points on its sides (Andrew 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

}  // namespace ostia::analysis
