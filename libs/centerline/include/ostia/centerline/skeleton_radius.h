#pragma once
/// \file Cross-sections along a skeleton: circles and ellipses from the gradient of an image.

#include "ostia/centerline/skeleton_graph.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::centerline {

struct SectionOptions {
  double sigma_mm = 0.4;  ///< of the Gaussian whose derivatives give the gradient, (0, 5] ([Luboz] 3.1)
  int rays = 32;          ///< across the vessel, [8, 256]
  double largest_radius_mm = 15.0;  ///< where the circle stops growing, (0, 100]
  double direction_mm =
      2.0;  ///< half the length of line that gives the plane's normal, at least; also a radius, (0, 20]
  /// A local maximum counts from this part of the highest one on, (0, 1]: the first that counts is the wall.
  double relevant = 0.5;
  bool recentre = true;        ///< sections are centred on the vessel, not on the line
  bool move_points = true;     ///< with `recentre`: the line's points move to the middle of their sections
  bool correct_blur = true;    ///< takes out that a blurred disc's steepest place lies inside of its edge
  double image_blur_mm = 0.0;  ///< standard deviation of the image's own blur, for that correction, [0, 5]
};
void validate(const SectionOptions& options);  ///< throws InvalidInput

/// What is found across the vessel at one point.
struct SkeletonSection {
  Vec3 centre = Vec3::Zero();   ///< of the circle, mm
  Vec3 normal = Vec3::UnitZ();  ///< of the plane; along the line
  double radius_mm = 0.0;       ///< of the circle
  Vec3 ellipse_centre = Vec3::Zero();
  Vec3 major_axis = Vec3::UnitX();  ///< unit, in the plane
  double semi_major_mm = 0.0, semi_minor_mm = 0.0;
  double support = 0.0;   ///< share of the rays that agree with the circle or the ellipse, [0, 1]
  bool measured = false;  ///< else interpolated along the line: no wall was found, or too few rays agree
};

struct MeasuredSkeleton {
  SkeletonGraph graph;  ///< with the circles' radii and, if asked for, their centres; nodes stay
  std::vector<std::vector<SkeletonSection>> sections;  ///< one a point of each edge, in the graph's order
  std::int64_t interpolated = 0;
};

/// Radii across the lines ([Luboz] 2.1): in the plane across, a circle grows about the point until the mean
/// gradient towards the inside has its first relevant local maximum. Then the steepest places on rays give
/// the circle and the ellipse of least squares, and the point moves to the circle's middle, three times in
/// turn. `mask`: 0 outside, else inside. Where fewer than half of the rays agree, as at junctions, the radius
/// is interpolated along the line. Points should be about a voxel apart and lines smooth. Same for any number
/// of threads. Throws InvalidInput for options out of range, an empty image, a graph with a fault or outside
/// the image; Cancelled.
MeasuredSkeleton measured(const SkeletonGraph& graph, const imaging::MaskVolume& mask,
                          const SectionOptions& options = {},
                          const core::TaskContext& task = core::no_task());
/// The same on a grey image in which vessels are bright.
MeasuredSkeleton measured(const SkeletonGraph& graph, const imaging::ImageVolume& image,
                          const SectionOptions& options = {},
                          const core::TaskContext& task = core::no_task());

/// The same on real values, such as the share of each voxel that lies inside a level set: what a mask rounds
/// away is then seen.
MeasuredSkeleton measured(const SkeletonGraph& graph, const imaging::FloatVolume& image,
                          const SectionOptions& options = {},
                          const core::TaskContext& task = core::no_task());

/// Where the radial gradient of a disc blurred by a Gaussian is steepest: the radius of the disc for that
/// place and sigma, both in mm. 0 where no disc is so small: the place is sigma at least.
double unblurred_radius(double steepest_mm, double sigma_mm);

}  // namespace ostia::centerline
