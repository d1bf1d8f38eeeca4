#pragma once
/// \file A finished run of a case, read back in Pa, mm and ml/s. See docs/reference/flow-results.md.

#include "ostia/core/task_context.h"
#include "ostia/solver/case_record.h"
#include "ostia/solver/openfoam_outcome.h"
#include "ostia/solver/wall_surface.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::solver {

/// What was computed at one time, or its mean over a cycle. Vectors are three numbers each, end to end.
struct FlowState {
  std::vector<double> velocity_m_s;      ///< of each element, tetrahedra first
  std::vector<double> pressure_pa;       ///< of each element
  std::vector<double> wall_shear_pa;     ///< vectors, of each facet of the wall: the blood's pull on the wall
  std::vector<double> wall_pressure_pa;  ///< of each facet of the wall
};

/// What flows through an open end; means over the last cycle where the flow is pulsatile.
struct EndFlow {
  std::string name;
  geometry::FaceKind kind = geometry::FaceKind::inlet;
  double area_mm2 = 0.0;
  double flow_ml_s = 0.0;  ///< into an inlet, out of an outlet
  double pressure_pa = 0.0;
};

struct FlowResult {
  geometry::MixedMesh mesh;
  CaseRecord record;
  OpenfoamOutcome run;
  WallSurface wall;
  FlowState last;  ///< of the last time
  // Of a pulsatile flow, over its last cycle.
  std::optional<FlowState> mean;
  std::vector<double> mean_shear_pa;  ///< time-averaged magnitude of the shear stress, of each facet (TAWSS)
  std::size_t times = 1;              ///< that the means are taken of
  std::vector<EndFlow> ends;          ///< inlets, then outlets, as the mesh has them
  /// What flows in and not out, relative to what flows in.
  double mass_balance_error() const;
};

/// Magnitudes of vectors.
std::vector<double> magnitudes(const std::vector<double>& vectors);

/// Vectors at the mesh's points: those of the elements about each, and 0 at the wall, to which blood sticks.
std::vector<double> velocity_at_points(const FlowResult& result, const FlowState& state);

/// Weights of samples of a periodic function for its mean over a period, by the trapezoidal rule: `times`
/// within one period, rising. All the same where they are evenly spaced.
std::vector<double> periodic_weights(const std::vector<double>& times, double period);

/// Half of one minus the mean vector's magnitude over the mean magnitude: 0 where the stress keeps its
/// direction, 0.5 where it goes to and fro (He and Ku 1996). 0 where there is no stress.
std::vector<double> oscillatory_shear_index(const std::vector<double>& mean_vectors,
                                            const std::vector<double>& mean_magnitudes);
/// 1 / ((1 - 2 OSI) TAWSS), 1/Pa (Himburg et al. 2004); NaN where the mean vector is below 1e-6 Pa.
std::vector<double> relative_residence_time(const std::vector<double>& mean_magnitudes,
                                            const std::vector<double>& indices);

/// The folder of a case's last time. Throws InvalidInput: not run, decomposed and not reconstructed.
std::filesystem::path result_time(const std::filesystem::path& case_folder);

/// Reads the last time of a case of write_openfoam_case, and of a pulsatile one all times of its last cycle,
/// one by one. `mesh_file` stands in for the case's own mesh.vtu where not empty. Throws InvalidInput: no
/// case, svMultiPhysics, not run, decomposed and not reconstructed, another mesh than the case's (by its
/// cells and points), fields missing or binary, a pulsatile run that has not come through one cycle.
FlowResult read_flow_result(const std::filesystem::path& case_folder,
                            const std::filesystem::path& mesh_file = {},
                            const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
