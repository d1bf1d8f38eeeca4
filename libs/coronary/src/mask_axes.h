#pragma once
/// \file From directed lines of a skeleton to the smooth axes of a tree.

#include "ostia/centerline/skeleton_graph.h"
#include "ostia/coronary/mask_tree.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

struct MaskAxes {
  geometry::VesselTree tree;          ///< a vessel for each end, "V1", ...
  std::vector<std::int32_t> ostia;    ///< the tree's nodes of the first `roots`, in their order
  std::vector<MaskEndChange> led_on;  ///< ostia right at their first fork
};

/// Each root's longest way is one smooth line through all forks, and so is each longest way that is left; a
/// daughter is led out of its parent's line and begins on it. `roots` first, then what else begins. Waves
/// shorter than `smooth_radii` radii go; ends are shortened by what the dome beyond them adds to a wall. The
/// lines are directed and without circles.
MaskAxes axes_of_lines(const centerline::SkeletonGraph& lines, const std::vector<std::int32_t>& roots,
                       double smooth_radii, double step_mm);

}  // namespace ostia::coronary
