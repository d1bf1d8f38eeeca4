#pragma once
/// \file Input of SimVascular's svMultiPhysics (once svFSIplus), in mm, g and s, in which pressure is in Pa.
/// See docs/reference/solver-cases.md for what of it was tested.

#include "ostia/core/task_context.h"
#include "ostia/solver/boundary_conditions.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::solver {

struct SvmultiphysicsCaseOptions {
  BoundaryFlowOptions flow;  ///< outlets of zero pressure or with resistance
  /// Of all outlets together, ml / mmHg, split as the flow is: makes each resistance a Windkessel (RCR) with
  /// 9 % of it in front of the compliance. Positive; needs OutletModel::resistance.
  std::optional<double> total_compliance_ml_mmhg;
  int cycles = 3;              ///< in [1, 100]; a steady flow is run for as many seconds
  int steps_per_cycle = 1000;  ///< in [10, 1000000]
  int results_per_cycle = 20;  ///< in [1, steps_per_cycle]
};
void validate(const SvmultiphysicsCaseOptions& options);

struct SvmultiphysicsCaseResult {
  BoundaryFlow flow;
  std::vector<std::string> warnings;
};

/// Writes `solver.xml`, `boundary_conditions.json` (docs/schemas/boundary-conditions.schema.json), the flow
/// of each inlet as `<inlet>.flow`, `mesh-complete`, and the case's record (case_record.h); whole or not at
/// all. `folder` must not exist or be empty. Throws as write_openfoam_case does, and InvalidInput for prisms,
/// quadratic elements and OutletModel::split.
SvmultiphysicsCaseResult write_svmultiphysics_case(const geometry::MixedMesh& mesh,
                                                   const SvmultiphysicsCaseOptions& options,
                                                   const std::filesystem::path& folder,
                                                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
