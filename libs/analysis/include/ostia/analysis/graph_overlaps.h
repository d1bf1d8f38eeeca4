#pragma once
/// \file Where vessels of a tree run into each other. See docs/methods/tree-measures.md.

#include "ostia/geometry/vessel_graph.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

struct OverlapOptions {
  /// Segments that share a point never count. Nor do those near each other along the vessel: whose way from
  /// one contact to the other is no longer than so many times the sum of their radii. Half of pi: a bend no
  /// tighter than its vessel is wide.
  double bend_reach = 1.5707963267948966;
  /// The same for ways that turn round at a fork: 4 lets two children of equal width part by 29 degrees.
  double fork_reach = 4.0;
  double least_depth = 1e-6;      ///< of the thinner one's radius: what is less deep does not count
  std::int64_t most = 1'000'000;  ///< pairs; more are a mistake, as of units
};
void validate(const OverlapOptions& options);  ///< throws InvalidInput

struct GraphOverlap {
  std::int32_t first = 0, second = 0;  ///< edges, the lower index first
  double depth_mm = 0.0;               ///< by how much the radii there exceed the distance of the axes
  geometry::Vec3 place;                ///< the middle of the overlap
};

/// All pairs of segments that run into each other, by their indices. A segment is taken as the union of the
/// balls along its axis, a truncated cone with rounded ends, and two of them are tested exactly. Networks
/// with loops may be asked for too. O(n log n); the same for any number of threads. Throws InvalidInput for
/// points out of range, places or radii that are not finite, radii below 0; ResourceError for more
/// pairs than asked for; Cancelled.
std::vector<GraphOverlap> find_overlaps(const geometry::VesselGraph& graph,
                                        const geometry::GraphIncidence& incidence,
                                        const OverlapOptions& options = {},
                                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
