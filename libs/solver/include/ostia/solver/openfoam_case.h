#pragma once
/// \file A case of laminar blood flow that OpenFOAM runs as it is (written for v1912, as Debian 12 has it):
/// simpleFoam when steady, pimpleFoam when pulsatile. See docs/reference/solver-cases.md.

#include "ostia/core/task_context.h"
#include "ostia/solver/boundary_conditions.h"
#include "ostia/solver/start_flow.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::solver {

struct OpenfoamCaseOptions {
  BoundaryFlowOptions flow;  ///< with a waveform the case is pulsatile
  int processes = 2;         ///< that the decomposed run is prepared for; in [1, 4096]
  // Steady.
  int iterations = 2000;    ///< at most; in [1, 1000000]
  double tolerance = 1e-6;  ///< initial residuals at which it stops; in [1e-12, 1e-2]
  StartOf start;            ///< what it begins with; none: blood at rest. The result is the same
  // Pulsatile.
  int cycles = 3;  ///< in [1, 100]
  /// Of all outlets together, ml / mmHg, split as the flow is: makes each resistance a Windkessel (RCR).
  /// Needs OutletModel::resistance and a waveform. Positive.
  std::optional<double> total_compliance_ml_mmhg;
  int samples_per_cycle = 100;        ///< of the inlet's velocities, straight between; in [10, 1000]
  int results_per_cycle = 20;         ///< fields written; in [1, 1000]
  double courant = 10.0;              ///< the largest, which the time steps follow; in [0.01, 50]
  std::optional<double> time_step_s;  ///< instead; positive
};
void validate(const OpenfoamCaseOptions& options);

struct OpenfoamCaseResult {
  BoundaryFlow flow;
  // Of a pulsatile case.
  double time_step_s = 0.0;  ///< the first, and each where it was given
  double steps = 0.0;        ///< of all cycles, about; more where a stenosis is faster than the ends
  double hours = 0.0;        ///< that they take, about, on the processes that the case is prepared for
  std::vector<std::string> warnings;
};

/// How long so many steps of pimpleFoam take, about, on a core of 3 GHz a process.
double openfoam_hours(std::size_t cells, double steps, int processes);

/// Writes constant/polyMesh (metres), 0/U, 0/p, constant, system, Allrun (`./Allrun`, or `./Allrun 4` for
/// four processes) and the case's record (case_record.h), whole or not at all. `folder` must not exist or be
/// empty. Velocities at the inlets are fully developed profiles of the real section (Womersley's when
/// pulsatile) with exactly the flow asked for through the mesh's facets. v1912 has no outlet with a
/// resistance that is coupled implicitly; with OutletModel::resistance Allrun runs a steady case again and
/// again until pressure is R times flow at each outlet, and sets the flows of a pulsatile one anew after each
/// cycle, until each harmonic of the pressure is the outlet's impedance times that of the flow. Throws
/// InvalidInput and GeometryError before anything is written (options, what boundary_flow refuses, quadratic
/// elements, a folder that holds something), IoError, ResourceError, Cancelled.
OpenfoamCaseResult write_openfoam_case(const geometry::MixedMesh& mesh, const OpenfoamCaseOptions& options,
                                       const std::filesystem::path& folder,
                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
