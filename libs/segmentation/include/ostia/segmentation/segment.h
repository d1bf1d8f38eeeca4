#pragma once
/// \file From an image and seeds to a surface.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/colliding_fronts.h"
#include "ostia/segmentation/feature.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/seeds.h"

#include <string>
#include <vector>

namespace ostia::segmentation {

/// What the surface is pulled to.
enum class WallFeature {
  edges,   ///< ridges of |grad I| of a smooth image function, corrected for the wall's curvature
           ///< (`EdgeFeature`)
  upwind,  ///< |grad I| on the voxels by eq. 4
  centred  ///< |grad I| on the voxels by centred differences
};

struct SegmentOptions {
  CollidingFrontsOptions fronts;
  WallFeature feature = WallFeature::edges;
  /// What is brighter than the lumen (a stent, a catheter) is taken as lumen. Off, the surface runs inside of
  /// it, as it should along calcified plaque. For `edges`; the voxel features do not know it.
  bool bright_is_lumen = false;
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

struct SegmentationResult {
  imaging::FloatVolume level_set;  ///< negative inside, mm; on `region`, which holds all branches
  imaging::Region region;          ///< voxels of the image
  std::vector<BranchDiagnostics> branches;
  int iterations = 0;
  bool converged = false;
  double rms_voxels = 0.0;
  bool touches_border = false;
  std::vector<std::string> warnings;
};

/// Every branch initialised by colliding fronts, the regions united (least value), and the union evolved as
/// one surface. Throws InvalidInput for no branch, and what the parts throw, the number of the branch in
/// front.
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
