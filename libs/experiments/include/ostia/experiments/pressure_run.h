#pragma once
/// \file One three-dimensional computation of the pressure experiment: meshed, run by OpenFOAM, read back as
/// mean pressures of sections.

#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ostia::experiments {

struct PressureMesh {
  double edge_ratio = 0.22;  ///< edge over radius, [0.05, 1]
  int layers = 3;            ///< of prisms, [0, 10]
  double layer_thickness = 1.0;
  int iterations = 2500;    ///< of simpleFoam at most, [10, 1000000]
  double tolerance = 1e-4;  ///< of its residuals, [1e-9, 1e-2]
};
void validate(const PressureMesh& mesh);  ///< throws InvalidInput

/// What is computed: a wall, and what flows through its root.
struct PressureTask {
  std::string id;
  std::string wall;         ///< what the model is made of, as text: equal texts are equal walls
  lumen::LumenModel model;  ///< of one root
  double flow_ml_s = 0.0;   ///< shared among outlets as diameter^2.27
  PressureMesh mesh;
};
/// SHA-256 of all of it but the name and the model. Numbers are taken to nine digits, so that it is the same
/// on processors whose last bits differ.
std::string digest_of(const std::string& wall, double flow_ml_s, const PressureMesh& mesh);

struct SectionPressure {
  std::int32_t vessel = 0;
  double s_mm = 0.0;       ///< on its axis
  double pressure_pa = 0;  ///< mean over the lumen; the outlets' is about 0
};
/// What came of it.
struct PressureRun {
  std::string digest;   ///< of its task
  std::string failure;  ///< why there is no result; empty: there is one
  bool converged = false;
  double iterations = 0.0;
  std::size_t cells = 0;
  double seconds = 0.0;                        ///< of all: wall, mesh, solution, reading
  double inlet_ml_s = 0.0;                     ///< as the result has it
  std::map<std::string, double> outlets_ml_s;  ///< by vessel
  std::vector<SectionPressure> sections;       ///< every quarter of a millimetre, vessel by vessel
};

/// Computes a task in a folder that is there and its own; what it leaves there stays beside the run. Throws
/// GeometryError, NumericalError and InvalidInput for what cannot be meshed or solved, others where nothing
/// can be.
using PressureRunner = std::function<PressureRun(
    const PressureTask& task, const std::filesystem::path& folder, const core::TaskContext& context)>;

struct OpenfoamRunnerOptions {
  double timeout_s = 7200.0;  ///< of the solution, > 0
  bool keep_cases = false;    ///< meshes and fields stay: about 100 MB a run
};
/// Meshes as `ostia mesh` does a case (pipeline::export_mesh), writes and runs a steady case (one process),
/// reads it (solver::read_flow_result) and averages its cells by volume within half a millimetre of each
/// section (analysis::flow_stations). Leaves speed.png. The runner throws NumericalError after the timeout.
PressureRunner openfoam_runner(const OpenfoamRunnerOptions& options = {});
/// Whether its program is there.
bool openfoam_is_there();

}  // namespace ostia::experiments
