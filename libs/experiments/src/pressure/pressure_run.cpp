// From a wall to mean pressures of its sections, by OpenFOAM.

#include "ostia/experiments/pressure_run.h"

#include "pressure/pressure_compare.h"

#include "ostia/analysis/wall_flow.h"
#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/pipeline/vessel_export.h"
#include "ostia/solver/flow_figures.h"
#include "ostia/solver/flow_result.h"
#include "ostia/solver/openfoam_launch.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <stop_token>
#include <thread>

namespace ostia::experiments {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using geometry::Vec3;

constexpr const char* program = "simpleFoam";
constexpr double section_step_mm = 0.25, section_width_mm = 0.5;
constexpr double reach_radii = 1.8;  // beyond that a cell belongs to no vessel
constexpr std::size_t cells_at_once = 512;

pipeline::MeshExportOptions mesh_options(const PressureTask& task, const core::TaskContext& context) {
  pipeline::MeshExportOptions options;
  options.sizing.edge_ratio = task.mesh.edge_ratio;
  options.surface_formats = {"vtp"};
  if (task.mesh.layers > 0) {
    options.volume.layers = meshing::BoundaryLayerOptions{};
    options.volume.layers->layers = task.mesh.layers;
    options.volume.layers->thickness = task.mesh.layer_thickness;
  }
  solver::OpenfoamCaseOptions openfoam;
  openfoam.flow.flow_ml_s = task.flow_ml_s;
  openfoam.flow.outlets =
      task.model.vessels.size() > 1 ? solver::OutletModel::split : solver::OutletModel::zero_pressure;
  openfoam.iterations = task.mesh.iterations;
  openfoam.tolerance = task.mesh.tolerance;
  openfoam.processes = 1;
  // The nearer a run begins to its end, the sooner it is there.
  openfoam.start = solver::start_from(measured_network(task.model, context));
  options.volume.solver_case = openfoam;
  return options;
}

/// Runs a case until it ends, is cancelled or has had its time.
void run_in_time(const fs::path& folder, double timeout_s, const core::TaskContext& task) {
  const core::TaskContext own;
  const auto until = Clock::now() + std::chrono::duration<double>(timeout_s);
  const std::jthread watcher([&](const std::stop_token& stop) {
    while (!stop.stop_requested() && !own.cancelled()) {
      if (task.cancelled() || Clock::now() > until) own.cancel();
      task.set_progress(own.progress());
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  try {
    solver::run_openfoam_case(folder, own);
  } catch (const Cancelled&) {
    task.throw_if_cancelled();
    throw NumericalError(std::string(program) + " has not ended within " +
                         core::fixed_text(timeout_s / 60.0, 0) + " minutes");
  }
}

/// The vessel whose part a place is in, and the abscissa of its foot; none beyond all lumens. At a fork the
/// vessel counts whose axis is nearest, by its radius.
analysis::WallFlowSample place_of(const lumen::LumenModel& model, const Vec3& place) {
  analysis::WallFlowSample best;
  best.vessel = -1;
  double least = reach_radii;
  for (const auto& vessel : model.vessels) {
    const geometry::AxisFoot foot = vessel->axis->nearest_foot(place);
    if (foot.past_end || foot.s_mm < vessel->own_from_mm) continue;
    const double away = foot.rho_mm / vessel->axis->radius(foot.s_mm);
    if (away >= least) continue;
    least = away;
    best.vessel = vessel->vessel;
    best.s_mm = foot.s_mm;
  }
  return best;
}

std::vector<SectionPressure> sections_of(const lumen::LumenModel& model, const solver::FlowResult& result) {
  const std::vector<Vec3> centres = geometry::element_centres(result.mesh);
  const std::vector<double> volumes = solver::element_volumes(result.mesh);
  std::vector<analysis::WallFlowSample> samples(centres.size());
  core::parallel_for(samples.size(), cells_at_once, [&](std::size_t i) {
    samples[i] = place_of(model, centres[i]);
    samples[i].area_mm2 = volumes[i];  // its weight
    samples[i].shear_pa = std::numeric_limits<double>::quiet_NaN();
    samples[i].pressure_pa = result.last.pressure_pa[i];
  });
  std::vector<SectionPressure> sections;
  for (const auto& vessel : model.vessels)
    for (const analysis::FlowStation& station :
         analysis::flow_stations(samples, vessel->vessel, vessel->own_from_mm, vessel->axis->length(),
                                 {section_step_mm, section_width_mm}))
      if (station.area_mm2 > 0.0 && std::isfinite(station.pressure_pa))
        sections.push_back({vessel->vessel, station.s_mm, station.pressure_pa});
  return sections;
}

/// Removes a folder when it is done with, however it ends; none where the path is empty.
struct FolderGone {
  fs::path folder;
  ~FolderGone() {
    std::error_code ignored;
    if (!folder.empty()) fs::remove_all(folder, ignored);
  }
};

/// "outlet_LAD" of a mesh is the vessel LAD.
std::string vessel_of_end(const std::string& end) {
  const std::size_t line = end.find('_');
  return line == std::string::npos ? end : end.substr(line + 1);
}

}  // namespace

void validate(const PressureMesh& mesh) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw InvalidInput("experiment pressure: " + what);
  };
  require(mesh.edge_ratio >= 0.05 && mesh.edge_ratio <= 1.0, "edges are 0.05 to 1 of the radius");
  require(mesh.layers >= 0 && mesh.layers <= 10, "there are 0 to 10 layers of prisms");
  require(mesh.iterations >= 10 && mesh.iterations <= 1000000, "10 to 1,000,000 iterations");
  require(mesh.tolerance >= 1e-9 && mesh.tolerance <= 1e-2, "residuals fall to 1e-9 to 1e-2");
}

std::string digest_of(const std::string& wall, double flow_ml_s, const PressureMesh& mesh) {
  using core::shortest_text;
  constexpr int digits = 9;
  return core::sha256(wall + " " + core::significant_text(flow_ml_s, digits) + " " +
                      shortest_text(mesh.edge_ratio) + " " + std::to_string(mesh.layers) + " " +
                      shortest_text(mesh.layer_thickness) + " " + std::to_string(mesh.iterations) + " " +
                      shortest_text(mesh.tolerance));
}

bool openfoam_is_there() {
  return core::program_on_path(program).has_value();
}

PressureRunner openfoam_runner(const OpenfoamRunnerOptions& options) {
  if (!(options.timeout_s > 0.0)) throw InvalidInput("experiment pressure: a run takes more than no time");
  return [options](const PressureTask& task, const fs::path& folder, const core::TaskContext& context) {
    if (!openfoam_is_there())
      throw IoError(std::string(program) +
                    " is not on the PATH, and not all runs are kept: install OpenFOAM (Debian: apt install "
                    "openfoam)");
    if (!solver::openfoam_can_work_in(folder))
      throw IoError("OpenFOAM cannot work in " + fs::absolute(folder).string() +
                    ": the path has blanks or quotation marks; keep runs elsewhere");
    const auto start = Clock::now();
    const fs::path mesh = folder / "mesh";
    const pipeline::MeshExportOptions how = mesh_options(task, context);
    std::error_code ignored;
    fs::remove_all(mesh, ignored);  // of a run that was killed
    const FolderGone after{options.keep_cases ? fs::path() : mesh};
    pipeline::export_mesh(mesh, task.model, how, context.sub(0.0, 0.1));
    const fs::path of_case = mesh / pipeline::name_in_folder(*how.volume.solver_case);
    run_in_time(of_case, options.timeout_s, context.sub(0.1, 0.95));
    const solver::FlowResult result = solver::read_flow_result(of_case, {}, context);
    PressureRun run;
    run.converged = result.run.converged;
    run.iterations = result.run.last;
    run.cells = result.mesh.tetrahedra.size() + result.mesh.prisms.size();
    for (const solver::EndFlow& end : result.ends)
      (end.kind == geometry::FaceKind::inlet ? run.inlet_ml_s : run.outlets_ml_s[vessel_of_end(end.name)]) =
          end.flow_ml_s;
    run.sections = sections_of(task.model, result);
    solver::speed_picture(result, context).write_png(folder / "speed.png", 1.0);
    run.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return run;
  };
}

}  // namespace ostia::experiments
