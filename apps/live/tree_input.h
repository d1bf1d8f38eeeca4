#pragma once
/// \file A vessel tree for the live viewer, and what is asked of it.

#include "options.h"

#include "ostia/analysis/tree_ruler.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/segment_blocks.h"

#include <memory>
#include <string>
#include <vector>

namespace ostia::live {

struct TreeInput {
  std::shared_ptr<const geometry::VesselGraph> graph;
  std::shared_ptr<const geometry::SegmentBlocks> blocks;
  std::shared_ptr<const analysis::TreeRuler> ruler;
  std::shared_ptr<const analysis::TreeRays> rays;
  std::string name, reference_name;
  std::vector<std::string> warnings;
};

/// Throws InvalidInput for a file without segments that can be drawn, one that names points which are not
/// there, and what io::read_graph throws.
TreeInput read_tree(const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
