#pragma once
/// \file Which elements a tree has, how long and wide they are, and which springs from which: no places yet.

#include "ostia/analysis/coronary_morphometry.h"
#include "ostia/core/task_context.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

struct GrowthElement {
  std::int32_t order = 1;
  std::int32_t parent = -1;   ///< element; -1: it continues a root
  std::int32_t fork = 0;      ///< at which of the parent's forks it springs, from 0; the last is its end
  std::int32_t segments = 1;  ///< forks at the end of each, some of them for capillaries that are not grown
  double length_mm = 0.0, diameter_mm = 0.0;
};

/// A root's order and diameter.
struct GrowthRoot {
  std::int32_t order = 1;
  double diameter_mm = 0.0;
};

/// Orders fall along the list: each element stands behind its parent. The first elements of each order's
/// share are the roots of that order; `root_element[i]` is that of root i. Numbers of daughters are the
/// matrix's, carried over from element to element, so that their totals are right to 1; diameters are normal
/// within the order's bounds and lengths are gamma distributed, both brought to the table's mean over the
/// elements that were made (roots keep their own diameters). Throws InvalidInput for an order that is not
/// there, ResourceError for more than `most_segments`.
struct GrowthTopology {
  std::vector<GrowthElement> elements;
  std::vector<std::int32_t> root_element;
  std::int64_t segments = 0;
};
GrowthTopology grow_topology(const Morphometry& table, const std::vector<GrowthRoot>& roots,
                             std::uint64_t seed, std::int64_t most_segments,
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
