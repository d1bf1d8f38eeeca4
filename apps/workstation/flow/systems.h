#pragma once
/// \file The cases of all trees of a mesh: left and right artery are two systems, which are run one after the
/// other and shown together.

#include "flow/dialog.h"

#include "ostia/solver/flow_report.h"

#include <QString>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::workstation {

/// Writes into `choice.folder`, whole or not at all: the case of one mesh itself, those of several each into
/// a folder named by its tree, with a script Allrun that runs them. Returns warnings. Throws as
/// pipeline::write_solver_case does, with the tree's name in front.
std::vector<std::string> write_cases(const FlowChoice& choice, const solver::BoundaryFlowOptions& flow,
                                     const std::vector<FlowMesh>& meshes, const core::TaskContext& task);

/// One case that has been run.
struct FlowRun {
  std::string name;  ///< of the tree; empty where there is one
  std::filesystem::path wall;
  solver::FlowReport report;
  bool converged = false;
  double last = 0.0;  ///< iteration, or s
  bool steady = true;
};
/// Runs the case in a folder, or each in a folder within it, and writes what was computed into the folder
/// `result` within each. Throws InvalidInput where there is none, and as run_openfoam_case and
/// read_flow_result do, with the tree's name in front.
std::vector<FlowRun> run_cases(const std::filesystem::path& folder, const core::TaskContext& task);

std::vector<std::filesystem::path> walls_of(const std::vector<FlowRun>& runs);
/// "tube-flow: converged, 57 iterations"; of several "LAD 57, RCA 43 iterations". Not converged as soon as
/// one is not.
QString outcome_of(const QString& name, const std::vector<FlowRun>& runs);
/// Why a person must look; empty: all is well.
QString reasons_of(const std::vector<FlowRun>& runs);

}  // namespace ostia::workstation
