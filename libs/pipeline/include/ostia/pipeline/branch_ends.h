#pragma once
/// \file Where the centerlines of a set of seed pairs begin and end.

#include "ostia/segmentation/seeds.h"
#include "ostia/segmentation/segment.h"

#include <string>
#include <vector>

namespace ostia::pipeline {

struct BranchEnds {
  geometry::Vec3 source = geometry::Vec3::Zero();
  std::vector<geometry::Vec3> targets;
};

/// The first pair's first point is the source. Of the other ends of pairs, those that no second pair touches
/// (within `same_mm`) are targets, in the order given; points in which pairs meet are bifurcations or joints.
/// Throws InvalidInput for no pair, or pairs that form a ring.
BranchEnds ends_of(const std::vector<segmentation::BranchSeeds>& branches, double same_mm = 1.0);

/// The branches that segmentation::segment_vessels has kept.
std::vector<segmentation::BranchSeeds> without(const std::vector<segmentation::BranchSeeds>& branches,
                                               const std::vector<segmentation::LeftOutBranch>& left_out);

/// "branch 2 is left out: ...", for a person who must look.
std::vector<std::string> reasons_of(const std::vector<segmentation::LeftOutBranch>& left_out);

}  // namespace ostia::pipeline
