#pragma once
/// \file The ways from the roots of a tree to its ends.

#include "heart_frame.h"

#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

struct TreePath {
  std::int32_t root = 0, end = 0;       ///< node ids
  std::vector<std::int32_t> segments;   ///< ids, proximal first
  std::vector<double> segment_ends_mm;  ///< abscissa at which each segment ends
  std::vector<Vec3> points;             ///< about 1 mm apart
  std::vector<double> s_mm;             ///< one a point
  std::vector<HeartPlace> at;           ///< one a point, in the frame set last

  double length() const { return s_mm.back(); }
  std::size_t index(double s) const;  ///< of the first point at or behind an abscissa
  /// Mean over the last `mm` of the path.
  HeartPlace ending(double mm = 5.0) const;
};

/// One for each end, in the order of the tree's nodes. The tree is sound.
std::vector<TreePath> paths_of(const geometry::VesselTree& tree);
/// Length of the way that two paths have in common from their root.
double shared_mm(const TreePath& a, const TreePath& b);

}  // namespace ostia::coronary
