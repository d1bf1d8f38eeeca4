#pragma once
/// \file The coronary tree, grown from its ostia through what looks like a vessel.

#include "ostia/coronary/ostia.h"
#include "ostia/segmentation/vesselness.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::coronary {

struct GrowthOptions {
  double wall_hu = 60.0;  ///< usual intensity of vessels' walls and muscle, [-100, 150]
  double fat_hu = -90.0;  ///< of what lies about arteries, [-200, 50]
  /// Share of the aorta's contrast above the wall that a voxel must have to be looked at, [0.1, 0.6].
  double least_contrast = 0.25;
  /// Share of its contrast above the fat with which a voxel must look like a tube (vesselness), [0.1, 0.6];
  /// more where there is noise, which looks so by chance.
  double least_tube = 0.25;
  double noise_hu = 0.0;       ///< standard deviation of the voxels, before the image was smoothed, [0, 500]
  double image_blur_mm = 0.3;  ///< the image's point spread (standard deviation), [0, 1.5]
  segmentation::TubeMethod likeness = segmentation::TubeMethod::flux;  ///< by which it is measured
  double largest_radius_mm = 4.5;  ///< what is bright so far about a voxel is a chamber, [2, 8]
  double least_branch_mm = 5.0;    ///< from its parent's axis, [2, 50]
  /// How far ahead of a branch's end it is sought again behind a lumen too narrow to be seen, [0, 20].
  double longest_gap_mm = 10.0;
  /// From the aorta's wall to an artery whose ostium is closed or was not seen, [0, 30]; 0: none is sought.
  double farthest_beginning_mm = 15.0;
};
void validate(const GrowthOptions& options);  ///< throws InvalidInput

/// From the ostium, or from its parent's axis, to its distal end; voxel by voxel.
struct GrownBranch {
  std::int32_t parent = -1;       ///< index of the branch it leaves; -1 at an ostium
  std::size_t parent_point = 0;   ///< on that branch
  std::size_t ostium = 0;         ///< from which the front came: one of those given, then of `lost`
  std::vector<Vec3> points;       ///< mm
  std::vector<double> radius_mm;  ///< of the tube that the voxel looks like
  std::vector<double> tube;       ///< how much, as a share of the contrast, [0, 1]
  /// Places, first and last, between which no lumen was seen: a throat, a closed stretch, or no way at all.
  std::vector<std::pair<std::size_t, std::size_t>> gaps;
};

struct GrownTree {
  std::vector<GrownBranch> branches;  ///< parents before children, longest first
  std::vector<Ostium> lost;           ///< beginnings beyond the aorta's wall, behind closed ostia
  std::int64_t voxels = 0;            ///< that the front reached
};

/// A front from the ostia goes through neighbouring voxels that look like tubes, faster the more they do; the
/// way to the place farthest along is a branch, and so is each way to the farthest place outside of those
/// already found, while it is long enough. Where a branch ends and one as wide and as bright goes on ahead of
/// it, joined by what looks a little like a tube, they are one. Where fewer than two trees leave the aorta,
/// fronts come from what begins beyond its wall, too. Deterministic. Throws InvalidInput, Cancelled.
GrownTree grow_tree(const imaging::ImageVolume& image, const Aorta& aorta, const std::vector<Ostium>& ostia,
                    const GrowthOptions& options = {}, const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
