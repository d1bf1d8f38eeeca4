#pragma once
/// \file Branches, bifurcations and sections for `ostia measure`.

#include "measure/measure.h"

#include "ostia/geometry/vessel_tree.h"
#include "ostia/pipeline/branch_report.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace ostia::app {

/// Whether anything of a branch report is wanted.
bool wants_branches(const MeasureCommand& command);
/// Throws UsageError for options that do not go together, or need a surface where the input is a tree.
void check_branch_options(const MeasureCommand& command);
/// What decides what the report is like.
nlohmann::json branch_parameters(const MeasureCommand& command);

/// Lines that the command was given beside its surface. Throws what io::read_centerlines throws.
std::optional<geometry::VesselTree> given_lines(const MeasureCommand& command);

/// `tree`: of the input. Tracts that a file brings (VMTK's or Ostia's) stay as they are. Warnings go to the
/// log.
pipeline::BranchReport branches_of(const MeasureCommand& command, const geometry::VesselTree& tree,
                                   const core::TaskContext& task);

/// A few lines on standard output.
void print_branches(const nlohmann::json& measures);

}  // namespace ostia::app
