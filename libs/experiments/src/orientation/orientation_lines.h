#pragma once
/// \file What the experiments on the phantom of tubes find in one scan: the level set and its skeleton.

#include "ostia/experiments/orientations.h"
#include "ostia/segmentation/level_set.h"

namespace ostia::experiments {

struct ScannedLines {
  imaging::ImageVolume scanned;
  segmentation::LevelSetResult surface;
  centerline::SectionOptions sections;
  pipeline::SkeletonResult lines;
};
/// Scans, filters, segments and thins ([Luboz] 3.1). Throws what the steps throw.
ScannedLines scanned_lines(const std::vector<PhantomTube>& tubes, const Orientation& orientation,
                           const OrientationsOptions& options, const core::TaskContext& task);

}  // namespace ostia::experiments
