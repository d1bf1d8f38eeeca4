#pragma once
/// \file From an image and seeds to a surface.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/diffusion.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/colliding_fronts.h"
#include "ostia/segmentation/feature.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/seeds.h"
#include "ostia/segmentation/tissue_removal.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::segmentation {

/// What the surface is pulled to.
enum class WallFeature {
  edges,    ///< ridges of |grad I| of a smooth image function, corrected for the wall's curvature
            ///< (`EdgeFeature`)
  upwind,   ///< |grad I| on the voxels by eq. 4
  centred,  ///< |grad I| on the voxels by centred differences
  gaussian  ///< |grad (G * I)|: derivatives of a Gaussian of `gaussian_sigma_mm`
};

/// Inflation by the vessel's own intensities ([Luboz] 2.1): G = exp(-(I - m)^2 / sigma^2) - tau. Outward
/// where I is like the vessel's, inward elsewhere: beyond a gap in the wall it comes back.
struct IntensityBalloon {
  double tau = 0.2;  ///< in (0, 1)
  /// m and sigma, HU; left out: median and robust deviation (at least 10 HU) of the initial region's inside.
  std::optional<double> mean_hu = std::nullopt, sigma_hu = std::nullopt;
};

struct SegmentOptions {
  CollidingFrontsOptions fronts;
  WallFeature feature = WallFeature::edges;
  /// What is brighter than the lumen (a stent, a catheter) is taken as lumen. Off, the surface runs inside of
  /// it, as it should along calcified plaque. For `edges`; the voxel features do not know it.
  bool bright_is_lumen = false;
  double gaussian_sigma_mm = 0.0;  ///< of the feature `gaussian`, in [0, 10]; 0: the least spacing
  /// None: the level set's inflation is 1 / (1 + feature). Its weight is `level_set.inflation`, above 0.
  std::optional<IntensityBalloon> balloon = std::nullopt;
  TissueOptions remove;  ///< taken out of the image before all else
  std::optional<imaging::DiffusionOptions> denoise = std::nullopt;  ///< then the whole image is diffused
  /// A branch that cannot be followed between its seeds (closed, or without contrast) is left out and told,
  /// as long as another one is there. Off, it is thrown about. Seeds outside of the image are thrown about
  /// always.
  bool leave_out_unfollowed = false;
  LevelSetOptions level_set;  ///< its feature_offset_voxels, curvature_needs_feature and ends are set from
                              ///< the image and the seeds; the fronts' way between the seeds is kept, too
};
/// Throws InvalidInput.
void validate(const SegmentOptions& options);

/// What happened to one branch.
struct BranchDiagnostics {
  IntensityRange range;
  bool range_was_chosen = false;
  double lumen_hu = 0.0;
  std::int64_t initial_voxels = 0;
  std::int64_t visited_voxels = 0;
  bool touches_border = false;
};

/// A branch that is not in the result.
struct LeftOutBranch {
  std::size_t branch = 0;  ///< index of those given
  std::string why;
};

struct SegmentationResult {
  imaging::FloatVolume level_set;           ///< negative inside, mm; on `region`, which holds all branches
  imaging::Region region;                   ///< voxels of the image
  std::vector<BranchDiagnostics> branches;  ///< of those that are not left out
  std::vector<LeftOutBranch> left_out;
  int iterations = 0;
  bool converged = false;
  double rms_voxels = 0.0;
  bool touches_border = false;
  double balloon_mean_hu = 0.0, balloon_sigma_hu = 0.0;  ///< m and sigma used; 0 without a balloon
  std::vector<std::string> warnings;
};

/// Every branch initialised by colliding fronts, the regions united (least value), and the union evolved as
/// one surface. Throws InvalidInput for no branch, and what the parts throw, the number of the branch in
/// front. What is left out, options allowing, takes with it the branches that hang on it by their seeds.
SegmentationResult segment_vessels(const imaging::ImageVolume& image,
                                   const std::vector<BranchSeeds>& branches,
                                   const SegmentOptions& options = {},
                                   const core::TaskContext& task = core::no_task());

struct SurfaceOptions {
  bool fill_cavities = true;  ///< closed bubbles inside are dropped
};

/// The zero level set as a closed, outward, manifold surface free of self-intersections: the parts that hold
/// a seed (all parts when there are none), and no other. It keeps 0.03 voxels clear of the voxels' centres,
/// so that no triangle is degenerate. Throws GeometryError when no part holds a seed.
geometry::TriMesh surface_of(const imaging::FloatVolume& level_set, const std::vector<Vec3>& seeds_mm,
                             const SurfaceOptions& options = {},
                             const core::TaskContext& task = core::no_task());

struct MaskSurfaceOptions {
  double sigma_voxels = 0.8;  ///< of the Gaussian, in voxels of the coarsest axis, >= 0
  bool largest_part_only = false;
};
void validate(const MaskSurfaceOptions& options);

/// The surface of a mask (nonzero is inside), smoothed below a voxel: the mask is blurred, but every voxel's
/// centre stays on its side, so nothing thin is lost and nothing merges. Closed at the image's border, too.
/// Throws InvalidInput for an empty mask.
geometry::TriMesh segment_mask(const imaging::MaskVolume& mask, const MaskSurfaceOptions& options = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
