#pragma once
/// \file The case of a solver that is written with a mesh.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/io/mesh_export.h"
#include "ostia/solver/openfoam_case.h"
#include "ostia/solver/svmultiphysics_case.h"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ostia::pipeline {

enum class SolverKind { openfoam, svmultiphysics };
inline constexpr std::array<SolverKind, 2> solver_kinds = {SolverKind::openfoam, SolverKind::svmultiphysics};

/// What is told of a solver, and what it takes.
struct SolverTraits {
  SolverKind kind;
  std::string_view name;    ///< as a user writes it, and in records: `openfoam`, `svmultiphysics`
  std::string_view title;   ///< "OpenFOAM"
  std::string_view suite;   ///< that it is part of, "SimVascular"; empty: of none
  std::string_view folder;  ///< of its case beside a mesh: `openfoam-case`
  io::MeshFormat mesh;      ///< whose elements it takes
  bool prisms;              ///< it takes a mesh that has them
  bool shares;              ///< it takes OutletModel::split
  std::string_view script;  ///< in the case's folder, that runs it; empty: there is none
  std::string_view run;     ///< what runs it within the case's folder
};
const SolverTraits& traits_of(SolverKind kind);
/// Throws InvalidInput that lists the solvers for any other name.
SolverKind solver_kind(std::string_view name);

/// An alternative for each of solver_kinds, in their order.
using SolverCase = std::variant<solver::OpenfoamCaseOptions, solver::SvmultiphysicsCaseOptions>;

SolverKind kind_of(const SolverCase& options);
/// With this flow, all else as the solver's options have it.
SolverCase solver_case(SolverKind kind, const solver::BoundaryFlowOptions& flow = {});
/// What flows, and what an inlet's name is given for.
const solver::BoundaryFlowOptions& flow_of(const SolverCase& options);
/// Throws InvalidInput for numbers out of range and what does not go together.
void validate(const SolverCase& options);
/// Throws InvalidInput, with the way out, where the solver does not take such elements.
void require_takes(const SolverCase& options, bool prisms, bool quadratic);
/// Throws InvalidInput for a flow through an inlet that is none of these ends, `inlet_<vessel>` or
/// `outlet_<vessel>`.
void require_inlets(const SolverCase& options, const std::vector<std::string>& ends);

/// SolverTraits::folder.
std::string name_in_folder(const SolverCase& options);
/// Canonical JSON of all that decides what is written.
std::string parameters_json(const SolverCase& options);

struct SolverCaseResult {
  solver::BoundaryFlow flow;
  // Of a pulsatile case of OpenFOAM: solver::OpenfoamCaseResult.
  double time_step_s = 0.0, steps = 0.0, hours = 0.0;
  std::vector<std::string> warnings;
};
/// Writes it, whole or not at all. Throws what write_openfoam_case and write_svmultiphysics_case throw.
SolverCaseResult write_solver_case(const geometry::MixedMesh& mesh, const SolverCase& options,
                                   const std::filesystem::path& folder,
                                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
