#pragma once
/// \file Branches and bifurcations of a lumen measured as VMTK's scripts measure them, as files of a folder.
/// See docs/methods/bifurcations.md.

#include "ostia/analysis/bifurcations.h"
#include "ostia/analysis/branch_mapping.h"
#include "ostia/analysis/branch_sections.h"
#include "ostia/io/surface_fields.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// A lumen's wall with what is known at its points.
struct BranchWall {
  geometry::TriMesh mesh;
  io::PointFields fields;
};

struct BranchReportOptions {
  bool bifurcations = false;
  bool sections = false;  ///< needs a wall
  analysis::SectionOptions section;
  std::optional<analysis::PatchOptions> patches;  ///< needs a wall
};

/// What was measured; what was not asked for is empty.
struct BranchReport {
  geometry::BranchedLines lines;
  std::optional<analysis::BifurcationMeasures> bifurcations;
  std::optional<analysis::SurfaceSections> sections;
  std::optional<analysis::MappedWall> mapped;
  std::optional<analysis::PatchedWall> patched;
  io::PointFields fields;  ///< of the wall, for the mapped one
  /// What patches have means of: the wall's fields, one name a component, and DistanceToCenterlines.
  std::vector<std::string> patch_values;
  std::vector<std::string> warnings;
};

/// Throws InvalidInput where something needs a wall and there is none, and what the analyses throw.
BranchReport measured_branches(geometry::BranchedLines lines, const std::optional<BranchWall>& wall,
                               const BranchReportOptions& options,
                               const core::TaskContext& task = core::no_task());

/// `branches.json` (docs/schemas/branch-measures.schema.json).
std::string branch_measures_json(const BranchReport& report);

/// Into a folder that is there: `branches.json`, tables (`branch-geometry.csv`, `bifurcations.csv`,
/// `bifurcation-vectors.csv`, `branch-sections.csv`, `bifurcation-sections.csv`, `patches.csv`) and, with the
/// names of VMTK's arrays, `bifurcation-systems.vtp`, `bifurcation-vectors.vtp`, `branch-sections.vtp`,
/// `bifurcation-sections.vtp`, `mapped-surface.vtp`, `patches.vtp`; those of what was asked for. Throws
/// IoError.
void write_branch_report(const std::filesystem::path& folder, const BranchReport& report);

}  // namespace ostia::pipeline
