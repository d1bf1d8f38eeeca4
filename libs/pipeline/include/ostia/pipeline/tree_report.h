#pragma once
/// \file The measures of a tree of vessels as a folder of tables, plots and a page. See
/// docs/methods/tree-measures.md.

#include "ostia/analysis/graph_overlaps.h"
#include "ostia/analysis/graph_report.h"
#include "ostia/pipeline/branch_report.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// A tree and all that was measured of it.
struct MeasuredTree {
  geometry::VesselGraph graph;
  std::string reference_name = "segment";  ///< what the file calls a segment: "line", "cell"
  analysis::TreeReport report;
  std::vector<analysis::GraphOverlap> overlaps;
  std::optional<BranchReport> branches;  ///< where they were asked for
};
/// All measures and the overlaps. Throws what analysis::measure_tree and analysis::find_overlaps throw.
MeasuredTree measured(geometry::VesselGraph graph, const core::TaskContext& task = core::no_task());

/// `measures.json` (docs/schemas/tree-measures.schema.json): totals, orders, scaling laws, angles, and how
/// many overlaps there are.
std::string tree_measures_json(const MeasuredTree& tree);
/// Diameter, length and number by order with their fits, Murray's exponents, angles at forks, and how long
/// and wide branches are. What has no values is left out.
std::vector<ReportPicture> tree_pictures(const MeasuredTree& tree);

/// Writes `measures.json`, a CSV each of segments, branches, orders, connectivity, forks and overlaps,
/// `report.html`, `pictures/*.png` and `*.svg`, what write_branch_report writes where branches were measured,
/// and `manifest.json` into a folder that appears whole or not
/// at all. Throws IoError, ResourceError, Cancelled.
void write_tree_report(const std::filesystem::path& folder, const MeasuredTree& tree, const JobKey& key,
                       double seconds_before, const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
