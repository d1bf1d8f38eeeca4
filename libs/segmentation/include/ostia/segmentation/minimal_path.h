#pragma once
/// \file A vessel by one click: the cheapest way through contrast-filled tubes from its distal end back to
/// the tree.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::segmentation {

using geometry::Vec3;

/// docs/minimal-path.md gives the method and the sources of the defaults.
struct MinimalPathOptions {
  double max_length_mm = 150.0;    ///< of the way; a front that has run so far gives up, [1, 1000]
  double step_mm = 0.5;            ///< between the points of the result, [0.1, 5]
  double snap_voxels = 2.0;        ///< how far off the lumen a click may lie, in the largest spacing, [0, 10]
  double largest_radius_mm = 4.0;  ///< of the lumen, [0.5, 10]
  double blur_sigma_mm = 0.3;  ///< the scanner's point spread (standard deviation), for the radii, [0, 1.5]
  double wall_hu = 50.0;       ///< usual CT number of the vessel's wall, for the radii, [-100, 200]
  double slowest = 0.02;       ///< speed outside of vessels as a part of the lumen's, (0, 0.5]
  std::int64_t most_voxels = 300'000;  ///< that the front may visit, >= 1000
};
void validate(const MinimalPathOptions& options);  ///< throws InvalidInput

/// Where a new vessel leaves the tree.
struct PathJunction {
  std::int32_t vessel = 0;    ///< the first vessel, in the tree's order, that owns the place
  double s_mm = 0.0;          ///< abscissa on geometry::vessel_axis of that vessel
  Vec3 point = Vec3::Zero();  ///< on that axis
};

struct MinimalPath {
  std::vector<Vec3> points;  ///< from the junction (or `from`) to the click, equal steps, centred, smooth
  std::vector<double>
      radius_mm;  ///< one a point: where the intensity falls half-way to wall or background, less the blur
  std::vector<float> contrast;           ///< one a point: 1 the lumen's intensity near by, 0 the background's
  std::optional<PathJunction> junction;  ///< of path_to_tree
  double length_mm = 0.0;
  /// [0, 1]: mean over the points of contrast x (share of the directions across that end at an edge).
  double evidence = 0.0;
  double lumen_hu = 0.0, background_hu = 0.0;  ///< what counted as lumen and as background
  std::int64_t visited = 0;                    ///< voxels that the front reached
  std::vector<std::string> warnings;           ///< "the way leaves the contrast for 4.0 mm, ..."
};

/// The way from a click (LPS, mm) to the tree: a front that runs fast where the intensity is that of the
/// tree's lumen near by and the neighbourhood looks like a tube, from the click until it enters the lumen of
/// any vessel (fast marching, Sethian 1996; minimal paths, Cohen and Kimmel 1997), and back down its arrival
/// times. Only what the front visits is looked at. Calcium is slow.
/// Throws InvalidInput for options out of range, a tree without axes, a click outside the image, in air, away
/// from any contrast (by more than the snap), or inside the tree's lumen; GeometryError where no vessel is
/// reached within `max_length_mm` or `most_voxels`; Cancelled.
MinimalPath path_to_tree(const imaging::ImageVolume& image, const Vec3& click,
                         const geometry::VesselTree& tree, const MinimalPathOptions& options = {},
                         const core::TaskContext& task = core::no_task());

/// The way between two places in the lumen of one vessel. Throws as path_to_tree.
MinimalPath path_between(const imaging::ImageVolume& image, const Vec3& from, const Vec3& to,
                         const MinimalPathOptions& options = {},
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
