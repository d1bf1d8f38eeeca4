#pragma once
/// \file Paths from one source joined to a tree of chains, and chains cut into segments.

#include "ostia/centerline/axis_fit.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::centerline {

/// A chain begins on its parent and runs to a target. Its first point is its parent's point `at`.
struct Chain {
  std::int32_t parent = -1;  ///< -1: begins at the source
  std::size_t at = 0;        ///< point of the parent
  Axis axis;                 ///< at least two points
};

struct ChainTree {
  std::vector<Chain> chains;  ///< parents first
  /// One a target: the chain and the point of it where the target's path ends.
  std::vector<std::pair<std::int32_t, std::size_t>> ends;
};

/// Joins paths from a common source (each at equal steps, source first, in the order of `order`): a path
/// leaves the others where it is, for the last time, closer to one of them than `merge_fraction` of the
/// inscribed radius there.
ChainTree merge_paths(const std::vector<Axis>& paths, const std::vector<std::size_t>& order,
                      double merge_fraction);

/// The tree, and the way to each target in it.
struct SplitTree {
  geometry::VesselTree tree;
  std::vector<std::vector<std::int32_t>>
      target_segments;                      ///< one a target: segment ids from the root; empty: at the root
  std::vector<std::size_t> passed_targets;  ///< targets on the way to others, which end no vessel
};

/// Cuts chains where others begin or targets end, and resamples each piece by a cubic spline at equal steps
/// no longer than `step_mm`. Radii are interpolated, never below the chain's least; frames run on from parent
/// to child. One vessel a target, named by `names` or vessel_1, vessel_2, ..., but none for a target on the
/// way to another: a vessel runs to an end of the tree.
SplitTree split_tree(const ChainTree& chains, double step_mm, const std::vector<std::string>& names);

}  // namespace ostia::centerline
