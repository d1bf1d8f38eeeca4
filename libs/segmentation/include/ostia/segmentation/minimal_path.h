#pragma once
/// \file A vessel by one click, two clicks or a rough line: the cheapest way through contrast-filled tubes,
/// centred in the lumen, with radii.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::segmentation {

using geometry::Vec3;

/// docs/methods/minimal-path.md gives the method and the sources of the defaults.
struct MinimalPathOptions {
  double max_length_mm = 250.0;    ///< of the way; a front that has run so far gives up, [1, 1000]
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
  std::vector<float> contrast;  ///< one a point: 1 the lumen's intensity near by, 0 the background's
  /// One a point: 1 where calcium lies on the axis or bounds the lumen, so that the axis is a bridge there.
  std::vector<std::uint8_t> near_calcium;
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

/// How a rough line is followed.
struct PathAlongOptions {
  MinimalPathOptions path;  ///< its bounds of the front are not asked: the line is one
  /// Beside the line, within which the cheapest way is sought; 0: none is, the line itself is
  /// centred, which asks for a line within the lumen, [0, 10].
  double corridor_mm = 3.0;
  /// Of the line's beginning and end that the image does not move or measure (they are smoothed with the
  /// rest); where it is more than 0, the end point stays exactly, [0, 1000].
  double fixed_start_mm = 0.0, fixed_end_mm = 0.0;
};
void validate(const PathAlongOptions& options);  ///< throws InvalidInput

/// The way along a rough line (two points or more, LPS, mm), as drawn by hand or found by a search: lumen is
/// what the brighter half of the places on it shows; the cheapest way beside it; centred and measured as the
/// other ways are. Throws InvalidInput for options out of range, a line outside the image, in air or without
/// 1 mm that is free, or an end that is free and away from any contrast; GeometryError where the corridor is
/// thinner than the voxels; Cancelled.
MinimalPath path_along(const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                       const PathAlongOptions& options = {}, const core::TaskContext& task = core::no_task());

/// The same for a branch: the line begins in the lumen of one of the tree's vessels (its axis need not begin
/// at a root); the way begins on that vessel's axis, where the branch's own direction meets it, and runs
/// straight from there until the branch is clear of the parent. `fixed_start_mm` is not asked. Throws also
/// GeometryError where no point of the line lies in the tree's lumen, and InvalidInput where all of it does.
MinimalPath path_along_to_tree(const imaging::ImageVolume& image, const std::vector<Vec3>& rough,
                               const geometry::VesselTree& tree, const PathAlongOptions& options = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
