#pragma once
/// \file From a rough way through a vessel to its axis: centred, smooth, with radii.

#include "path/speed.h"

#include <vector>

namespace ostia::segmentation::detail {

/// What rays across the vessel found at a point of its axis.
struct PathSection {
  Vec3 shift = Vec3::Zero();    ///< towards the middle of the lumen, mm
  double radius_mm = 0.0;       ///< median over the rays that end at an edge; 0 where too few do
  double seen_radius_mm = 0.0;  ///< the same with the blur
  double contrast = 0.0;
  double edges = 0.0;    ///< share of the rays that end at an edge
  bool calcium = false;  ///< the axis runs through calcium
  bool near_calcium =
      false;  ///< it does, or calcium bounds the lumen: edges and middle are not to be trusted
};

/// The radius of a disc whose picture, blurred by a Gaussian of standard deviation `sigma_mm`, has fallen to
/// half of its centre's value at `half_mm`; three quarters of sigma at least, since
/// smaller ones look alike.
double unblurred_radius(double half_mm, double sigma_mm);

/// How rays look for the edge of the lumen.
struct RayOptions {
  double largest_radius_mm = 4.0;
  double blur_sigma_mm = 0.0;  ///< of the intensities that the rays see, all told
  double wall_hu = -1000.0;    ///< what surrounds the lumen, where that is brighter than the background
  /// Of the vessel about this place; where it is brighter than the levels' lumen, calcium is brighter still.
  double lumen_hu = -1000.0;
};

/// How bright a vessel's lumen is about each point of its line: the median over 15 mm of the line,
/// so that a nodule in it does not matter. A vessel may be brighter than where its levels were taken.
std::vector<double> lumen_along(TubeSpeed& image, const std::vector<Vec3>& line);

/// Rays normal to `tangent`, each to where the intensity has fallen half-way from the centre's to the
/// background's, or risen half-way to calcium.
PathSection look_across(TubeSpeed& image, const Vec3& centre, const Vec3& tangent, const RayOptions& rays);

/// Smoothed with fixed ends, at equal steps no longer than `step_mm`. `weights`: one a point, or none.
std::vector<Vec3> smoothed_line(const std::vector<Vec3>& points, double step_mm, double lambda_mm3,
                                const std::vector<double>& weights = {});

/// How much of a line's ends the image does not move; where it is more than 0, the end point stays exactly.
struct FixedEnds {
  double start_mm = 0.0, end_mm = 0.0;
};

/// Moves the points to the middle of the lumen, in turn with smoothing, but for the fixed ends, which are
/// only smoothed. BackgroundTask calcium the line goes on smoothly between what lies before and behind it.
std::vector<Vec3> centred_line(TubeSpeed& image, std::vector<Vec3> points, double step_mm,
                               const FixedEnds& fixed, const RayOptions& rays);

}  // namespace ostia::segmentation::detail
