#pragma once
/// \file From the tree as it was grown, voxel by voxel, to axes in the middle of the lumen.

#include "ostia/coronary/tree_growth.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::coronary {

/// docs/methods/coronary-tree.md gives the method.
struct AxesOptions {
  double step_mm = 0.5;            ///< between points of the axes, at most, [0.1, 2]
  double largest_radius_mm = 4.0;  ///< of the lumen, [0.5, 10]
  double blur_sigma_mm = 0.3;      ///< the scanner's point spread (standard deviation), [0, 1.5]
  double wall_hu = 50.0;           ///< usual intensity of vessels' walls, for the radii, [-100, 200]
  double least_branch_mm = 5.0;    ///< shorter ones, measured from the parent's axis, are left out, [1, 50]
  double ostium_mm = 2.0;          ///< of an axis behind its ostium that is not centred, [0.5, 10]
};
void validate(const AxesOptions& options);  ///< throws InvalidInput

/// How sure a vessel's axis is.
struct AxisNotes {
  std::int32_t vessel = 0;            ///< its id in the tree
  double evidence = 0.0;              ///< of its own stretch, as segmentation::MinimalPath has it, [0, 1]
  std::vector<std::string> warnings;  ///< "the way leaves the contrast for 4.0 mm, ..."
};

struct CentredTree {
  geometry::VesselTree tree;          ///< sound; a root for each ostium; vessels "V1", "V2", ..., mm
  std::vector<AxisNotes> notes;       ///< one a vessel, in the tree's order
  std::vector<std::string> warnings;  ///< branches that were left out, and why
  std::vector<std::string> left_out;  ///< of these the ones that could not be followed: a person must look
};

/// Each branch is centred in the lumen, smoothed and measured (segmentation::path_along); a daughter begins
/// on its parent's axis, where its own direction meets it. Deterministic, the same for any number of threads.
/// Throws InvalidInput for options out of range or a grown tree that is not one (parents after children, no
/// branch, an unknown ostium), GeometryError where no branch at all could be followed, Cancelled.
CentredTree centred_tree(const imaging::ImageVolume& image, const GrownTree& grown,
                         const std::vector<Ostium>& ostia, const AxesOptions& options = {},
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
