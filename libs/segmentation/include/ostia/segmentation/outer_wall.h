#pragma once
/// \file A vessel's outer wall about its lumen.

#include "ostia/segmentation/lumen_boundary.h"

#include <string>
#include <vector>

namespace ostia::segmentation {

/// docs/methods/outer-wall.md gives the method and the sources of the defaults.
struct OuterWallOptions {
  double radial_step_mm = 0.1;        ///< of the grid of candidate radii, [0.02, 0.5]
  double least_thickness_mm = 0.1;    ///< [0, 1]
  double largest_thickness_mm = 3.0;  ///< of wall and plaque together, [0.5, 6]
  double blur_sigma_mm = 0.3;         ///< the scanner's point spread (standard deviation), [0, 1.5]
  double wall_hu = 50.0;              ///< usual CT number of the vessel's wall, [-20, 200]
  double fat_hu = -90.0;  ///< where the image shows none about the vessel, [-200, -40]; else its own is taken
  double largest_slope_along = 1.0;   ///< limit of |dr/ds|, [0.05, 10]
  double largest_slope_around = 1.0;  ///< limit of |dr/dtheta| / r, [0.05, 10]
};
void validate(const OuterWallOptions& options);

struct OuterWall {
  /// On the lumen's own rays and rows, outside it by `least_thickness_mm` or more. `lumen_hu` and
  /// `lumen_sigma_hu` are measured anew. `confidence` is 0 where no edge is seen and the wall is a bridge
  /// between its neighbours.
  LumenBoundary surface;
  std::vector<double> lumen_hu, fat_hu;  ///< one a row: how bright the lumen and the fat about it are
  double seen_share = 0.0;               ///< of the rays that end in fat
};

/// The border between a vessel's wall, plaque included, and the fat about it. Muscle, a chamber or another
/// vessel beyond give no edge: there the wall is a smooth bridge from where fat is seen. Least cost over all
/// surfaces outside the lumen within the slope limits (graph cut), then placed between grid radii by a model
/// of the blurred wall. `lumen` lies on rays about `axis`; rows whose axis lies outside the lumen or the
/// image have no confidence. Throws InvalidInput (bad options, an empty image or boundary, rows beyond the
/// axis, more than 10^7 candidates), Cancelled.
OuterWall outer_wall(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                     const LumenBoundary& lumen, const OuterWallOptions& options = {},
                     const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
