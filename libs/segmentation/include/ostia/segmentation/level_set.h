#pragma once
/// \file Implicit deformable surfaces ([Antiga] eq. 1) as a sparse field (Whitaker 1998).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

#include <limits>
#include <optional>
#include <vector>

namespace ostia::segmentation {

/// An end of the surface that stands across the open lumen, where no wall holds it. Within three voxels of
/// its plane and `radius_mm` of its point the surface may move sideways, to the wall, but not along the
/// vessel.
struct LevelSetEnd {
  Vec3 point = Vec3::Zero();     ///< LPS, mm
  Vec3 outward = Vec3::UnitZ();  ///< along the vessel, away from it; any length but 0
  double radius_mm = 0.0;
  bool hold_beyond = true;  ///< what lies beyond the plane stays where it is; not for vessels of few voxels
};

/// The wall as the image itself shows it: the feature is log(1 + P^2/k^2)/2 with P = |grad I| of the cubic
/// B-spline that has the voxels as coefficients, differentiated exactly, so its ridges are those of P and are
/// known between voxels.
struct EdgeFeature {
  double noise_hu_per_mm =
      50.0;  ///< k > 0: gradients below it pull hardly at all, above it all walls pull alike
  /// A round wall's ridge lies sigma^2/2 times its curvature inside of the wall when the image is blurred by
  /// sigma, and the zero of the Laplacian as much outside; half-way between them is the wall (Verbeek and van
  /// Vliet 1994; Bouma et al. 2005).
  bool curvature_correction = true;
  /// Variances of the image's blur along its axes; only their ratios count. Where they differ, a ridge lies
  /// tr(S K)/2 inside of the wall, S the blur and K the wall's curvature in the wall's plane.
  Vec3 blur = Vec3::Ones();
  /// P from one-sided differences towards what is darker ([Antiga] eq. 4), one least spacing long, at any
  /// place and not on voxels alone; each is half its length beside its place, and is sampled where it
  /// belongs.
  bool upwind = false;
  /// Intensities above this count as this: a stent or a catheter in the lumen shows no wall of its own.
  /// Infinite: off.
  double brightest_hu = std::numeric_limits<double>::infinity();
};

/// Which curvature of the surface the second term of eq. 1 evens out ([Antiga] 3.3).
enum class CurvatureTerm {
  mean,    ///< 2H, the sum of both principal curvatures: smooths in all directions, and shrinks every tube
  minimal  ///< the smaller principal curvature (Lorigo et al., Med. Image Anal. 5:195-206, 2001, after
           ///< Ambrosio and Soner): 0 on a straight tube, whose radius it leaves alone; smooths along it
};

struct LevelSetOptions {
  double inflation =
      0.0;  ///< w1: outward speed w1 G(x), G = `inflation_speed` where given, else 1/(1 + feature)
  double curvature = 0.1;  ///< w2 >= 0: shrinks what bulges, by w2 * 2H; beyond 0.3 a voxel 2H counts as
                           ///< that, so that thin vessels stay
  CurvatureTerm curvature_term = CurvatureTerm::mean;  ///< `minimal` puts the smaller principal curvature in
                                                       ///< the place of 2H
  double advection = 1.0;                              ///< w3 >= 0: pulls to the ridges of the feature
  int iterations_max = 200;                            ///< >= 0
  /// Done when the root mean square net motion of the surface in ten iterations falls below this many voxels
  /// (least spacing). Steps are shortened, to a quarter at most, when the surface swings about its place, and
  /// at each voxel that the surface has crossed more than twice.
  double rms_tolerance_voxels = 0.01;
  /// The upwind gradient magnitude (eq. 4) carries the derivative half a voxel towards the outside; its ridge
  /// lies that much inside of the wall. 0.5 samples it where it belongs, 0 is for centred features.
  double feature_offset_voxels = 0.0;
  /// Where the feature is below this, curvature is faded out: a front that stands in the open lumen (at a
  /// seed, across a side branch) stays. 0: nowhere.
  double curvature_needs_feature = 0.0;
  std::vector<LevelSetEnd> ends;
  /// Points (world, mm) whose voxels stay inside: along a connected way a thin vessel cannot break. Those
  /// outside of the grid or of the initial surface do not count.
  std::vector<Vec3> kept;
};
/// Throws InvalidInput.
void validate(const LevelSetOptions& options);

struct LevelSetResult {
  imaging::FloatVolume
      level_set;  ///< negative inside; signed distance in mm about the surface, +-(3 voxels) beyond
  int iterations = 0;
  bool converged = false;
  double rms_voxels = 0.0;          ///< motion of the surface in the last ten iterations
  std::vector<double> rms_history;  ///< one for every ten iterations
};

/// Evolves phi_t = -w1 G |grad phi| + w2 2H |grad phi| - w3 grad P . grad phi (advection moves the surface
/// along +grad P, to the ridges of P). `initial`: negative inside, only signs and zero crossings count.
/// `feature`: P on the same grid; its scale sets time alone, as speeds are limited to one voxel a step.
/// Advection is upwind (Osher and Sethian 1988), curvature central; both see the spacing of each axis. Speeds
/// are taken at the foot point of each voxel on the surface, so the result is exact below a voxel. Throws
/// InvalidInput (grids differ; not finite; nothing inside), NumericalError (the surface vanished).
LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::FloatVolume& feature,
                         const LevelSetOptions& options = {},
                         const core::TaskContext& task = core::no_task());
/// The same on the walls of an image, on whose grid the voxels of `initial` lie.
LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                         const EdgeFeature& edge, const LevelSetOptions& options = {},
                         const core::TaskContext& task = core::no_task());
/// Both with a speed image G of its own for the inflation; the surface goes inwards where G is below 0.
LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::ImageVolume& image,
                         const EdgeFeature& edge, const imaging::FloatVolume& inflation_speed,
                         const LevelSetOptions& options = {},
                         const core::TaskContext& task = core::no_task());
LevelSetResult level_set(const imaging::FloatVolume& initial, const imaging::FloatVolume& feature,
                         const imaging::FloatVolume& inflation_speed, const LevelSetOptions& options = {},
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
