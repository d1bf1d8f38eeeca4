#pragma once
/// \file The case of a solver that is written with a mesh.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/solver/openfoam_case.h"
#include "ostia/solver/svmultiphysics_case.h"

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace ostia::pipeline {

using SolverCase = std::variant<solver::OpenfoamCaseOptions, solver::SvmultiphysicsCaseOptions>;

/// What flows, and what an inlet's name is given for.
const solver::BoundaryFlowOptions& flow_of(const SolverCase& options);
/// Throws InvalidInput for numbers out of range and what does not go together.
void validate(const SolverCase& options);
/// Throws InvalidInput, with the way out, where the solver does not take such elements.
void require_takes(const SolverCase& options, bool prisms, bool quadratic);
/// Throws InvalidInput for a flow through an inlet that is none of these ends, `inlet_<vessel>` or
/// `outlet_<vessel>`.
void require_inlets(const SolverCase& options, const std::vector<std::string>& ends);

/// Of the folder beside a mesh: `openfoam-case`, `svmultiphysics-case`.
std::string name_in_folder(const SolverCase& options);
/// Canonical JSON of all that decides what is written.
std::string parameters_json(const SolverCase& options);

struct SolverCaseResult {
  solver::BoundaryFlow flow;
  double time_step_s = 0.0;  ///< of a pulsatile case of OpenFOAM
  std::vector<std::string> warnings;
};
/// Writes it, whole or not at all. Throws what write_openfoam_case and write_svmultiphysics_case throw.
SolverCaseResult write_solver_case(const geometry::MixedMesh& mesh, const SolverCase& options,
                                   const std::filesystem::path& folder,
                                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
