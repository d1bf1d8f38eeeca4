#pragma once
/// \file The tree as the bright region about the ostia and its skeleton: a method to compare with. Threshold,
/// region growing, removal of what is wider than a vessel and thinning, as in the connected component and
/// morphology based methods of the coronary challenge (P. Kitslaar et al., 2008).

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::experiments {

struct RegionGrowingOptions {
  double blood_mm = 3.0;    ///< voxels so near to an ostium tell what blood looks like: their upper quartile
  double tissue_hu = 50.0;  ///< what is not contrast
  double level = 0.5;       ///< the threshold, from tissue (0) to blood (1)
  double chamber_mm = 3.5;  ///< what holds a ball of this radius is no coronary artery
  double begin_mm = 6.0;    ///< voxels of the region so near to an ostium are where growing begins
  double most_ml = 15.0;    ///< a larger region of one ostium has leaked: its threshold is raised ...
  double step_hu = 10.0;    ///< ... by so much
  double prune_mm = 5.0;    ///< shorter leaves of the skeleton go
};

/// What grew from one ostium.
struct GrownPart {
  double threshold_hu = 0.0, volume_ml = 0.0;
  bool leaked = false;  ///< no threshold below blood kept it small: it is left out
};

struct GrownRegion {
  geometry::VesselTree tree;  ///< from the ostia on; empty where nothing grew
  double blood_hu = 0.0;
  std::vector<GrownPart> parts;  ///< one an ostium
};

/// `ostia`: where the arteries leave the aorta, LPS, mm, one at least. The same for any number of threads.
/// Throws InvalidInput without ostia, Cancelled.
GrownRegion grow_region(const imaging::ImageVolume& image, const std::vector<geometry::Vec3>& ostia,
                        const RegionGrowingOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
