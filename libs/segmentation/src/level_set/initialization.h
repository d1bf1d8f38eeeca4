#pragma once
/// \file Which of the branches that were asked for can be followed in the image.

#include "ostia/segmentation/segment.h"

#include <string>
#include <utility>
#include <vector>

namespace ostia::segmentation::detail {

struct InitializedBranches {
  std::vector<std::size_t> index;  ///< of those that were asked for
  std::vector<BranchSeeds> branches;
  std::vector<InitialRegion> parts;  ///< of each
  std::vector<LeftOutBranch> left_out;
};

/// The initial region of each branch, by colliding fronts. Throws what they throw, with the branch's number;
/// where `leave_out`, only if none can be followed or a seed lies outside of the image.
InitializedBranches initialize_branches(const imaging::ImageVolume& image,
                                        const std::vector<BranchSeeds>& branches,
                                        const CollidingFrontsOptions& fronts, bool leave_out,
                                        const core::TaskContext& task);

/// The branches that are joined to others by their seeds in `all`, and no more in `kept` to those that most
/// of the kept hang together with: indices of `all`. `same_mm`: seeds no farther apart are one.
std::vector<std::size_t> cut_off(const std::vector<BranchSeeds>& all, const std::vector<std::size_t>& kept,
                                 double same_mm = 1.0);

}  // namespace ostia::segmentation::detail
