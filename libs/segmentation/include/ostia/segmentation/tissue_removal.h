#pragma once
/// \file Bone, calcium and skin taken out of a CT before vessels are looked for ([Luboz] 2.1).

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

#include <cstdint>
#include <vector>

namespace ostia::segmentation {

/// What a voxel of the mask was taken for.
enum class Tissue : std::uint8_t { kept = 0, bone = 1, calcium = 2, skin = 3 };

struct TissueOptions {
  bool bone = false;
  bool calcium = false;
  bool skin = false;
  /// At least as bright are contrasted blood, marrow and bone; HU.
  double candidate_hu = 150.0;
  /// At least as bright is the shell of a bone: half-way from soft tissue to cortical bone. Above
  /// candidate_hu.
  double shell_hu = 300.0;
  double contact_mm = 1.2;  ///< necks thinner than twice this between bone and vessel are cut, in [0, 5]
  double calcium_hu = 0.0;  ///< calcium is at least as bright; 0: half the lumen's contrast above the seeds
  double largest_calcium_mm3 = 500.0;  ///< what is larger (a stent, a bone) is not calcium, > 0
  double skin_mm = 4.0;                ///< thickness of the layer under the air about the body, in (0, 20]
  double fill_hu = 50.0;               ///< what is removed gets this: soft tissue, no wall to air
};
/// Throws InvalidInput that names the option.
void validate(const TissueOptions& options);

/// A mask of `Tissue`s on the image's grid. `lumen_mm`: points in the lumen (the seeds); whatever is
/// connected with them is not bone, and calcium needs them.
///
/// Bone: on voxels of about 1 mm the parts of what is as bright as `candidate_hu`, their necks cut by an
/// erosion of `contact_mm`, are bones where their rim is brighter than their middle: a shell about marrow;
/// a contrasted vessel is brightest in its middle. On the image's own voxels a bone is what is as bright as
/// `shell_hu` within 1.5 mm of such a part, its middle, and what these enclose unless it is dark (a canal, a
/// disc). Calcium: bright spots up to a size, with what is next to them and brighter than the lumen
/// (blooming). Skin: what is near the air outside of the body (not that in the lungs). Throws InvalidInput,
/// Cancelled.
imaging::MaskVolume tissues_to_remove(const imaging::ImageVolume& image, const std::vector<Vec3>& lumen_mm,
                                      const TissueOptions& options,
                                      const core::TaskContext& task = core::no_task());

/// The image with `fill_hu` where the mask is not 0. Throws InvalidInput for another grid.
imaging::ImageVolume without_tissues(const imaging::ImageVolume& image, const imaging::MaskVolume& mask,
                                     double fill_hu);

}  // namespace ostia::segmentation
