#pragma once
/// \file A case's lumen, wall and plaque as voxels, for programs that learn from them.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/session/outer_walls.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::session {

/// What the voxels say; docs/methods/mask-tree.md has the values.
enum class VoxelLabels {
  lumen,     ///< 1 in the lumen
  segments,  ///< 1 to 18: the standard segment whose lumen it is; 19: a vessel that has no number
  wall,      ///< 1 lumen, 2 between lumen and outer wall
  plaque     ///< 1 lumen, 2 wall that is thin, 3 to 6: low attenuation, fibrofatty, fibrous, calcified
};
inline constexpr std::uint8_t label_lumen = 1, label_wall = 2, label_first_plaque = 3,
                              label_other_vessel = 19;

struct LabelCount {
  std::uint8_t value = 0;
  std::string name;  ///< "lumen", "pLAD (6)", "calcified"
  std::int64_t voxels = 0;
};

struct LabelVolume {
  imaging::MaskVolume volume;
  std::vector<LabelCount> counts;     ///< of values that are there, rising
  std::vector<std::string> warnings;  ///< a vessel outside the grid, without an outer wall
};

/// On the grid of a CT: a voxel has the label of what its centre lies in. The lumen is the model's, solved
/// afresh, branches joined as they are on the screen. `image`: the CT, for outer wall and plaque alone
/// (vessel_walls), which are told where a vessel runs by itself. Throws InvalidInput for an empty grid or
/// model, for walls without an image, and where no voxel of the grid lies in a vessel ("another patient's
/// grid"); ResourceError, Cancelled. The same for any number of threads.
LabelVolume label_volume(const lumen::LumenModel& model, const imaging::Geometry& grid, VoxelLabels what,
                         const imaging::ImageVolume* image = nullptr, const OuterWallsOptions& walls = {},
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
