#include "tree_input.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_units.h"
#include "ostia/io/graph_file.h"

#include <utility>

namespace ostia::live {

TreeInput read_tree(const Options& options, const core::TaskContext& task) {
  task.set_stage("reading");
  io::LoadedGraph loaded = io::read_graph(options.motion, task.sub(0.0, 0.4));
  const geometry::GraphFaults faults = geometry::find_faults(loaded.graph, task.sub(0.4, 0.5));
  const std::string found = geometry::summary(faults, loaded.graph, loaded.reference_name);
  if (faults.count(geometry::GraphFaultKind::index_out_of_range) > 0)
    throw InvalidInput(options.motion.string() + ": " + found +
                       "; `ostia tree --repair` writes it without what is wrong");
  TreeInput input;
  input.name = options.motion.filename().string();
  input.reference_name = loaded.reference_name.empty() ? "segment" : loaded.reference_name;
  input.warnings = std::move(loaded.warnings);
  if (!faults.sound_trees())
    input.warnings.push_back(input.name + " is shown as it is, with " + found +
                             "; `ostia tree --repair` mends it");
  input.graph = std::make_shared<const geometry::VesselGraph>(std::move(loaded.graph));
  input.blocks = std::make_shared<const geometry::SegmentBlocks>(*input.graph, task.sub(0.5, 0.6));
  if (input.blocks->size() == 0)
    throw InvalidInput(options.motion.string() + ": there is no segment with finite places to be shown");
  task.set_stage("measuring");
  input.ruler = std::make_shared<const analysis::TreeRuler>(input.graph, task.sub(0.6, 0.9));
  input.rays = std::make_shared<const analysis::TreeRays>(input.graph, task.sub(0.9, 1.0));
  if (const std::string doubt = geometry::unit_doubt(geometry::facts_of(*input.graph)); !doubt.empty())
    input.warnings.push_back(doubt);
  if (!input.ruler->why_no_tree().empty()) input.warnings.push_back(input.ruler->why_no_tree());
  return input;
}

}  // namespace ostia::live
