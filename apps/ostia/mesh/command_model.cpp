#include "commands.h"
#include "flow/solver_case.h"
#include "input/mask_input.h"
#include "input/seeds.h"
#include "mesh/ends_not_cut.h"
#include "mesh/mesh_input.h"
#include "mesh/mesh_vessels.h"
#include "options/model_options.h"
#include "output/kept_results.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/phantom/builtin_case.h"
#include "ostia/pipeline/model_folder.h"
#include "ostia/pipeline/report.h"
#include "ostia/pipeline/vessel_forecast.h"

#include <chrono>
#include <cstdio>
#include <optional>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

struct Job {
  pipeline::Source source;
  pipeline::ModelOptions options;
  pipeline::JobKey key;
  std::optional<phantom::BuiltinCase> builtin;
};

void take_builtin(const ModelCommand& command, Job& job, const core::TaskContext& task) {
  phantom::BuiltinOptions options;
  options.seed = command.seed;
  job.builtin = phantom::make_builtin_case(options, task);
  job.source = pipeline::source_of(*job.builtin);
  apply(command.lumen, SeedFrame{}, job.options);
  job.options.branches = pipeline::branches_of(*job.builtin);
}

/// An image of vessels alone is likelier to be a mask than a CT without its branches.
void ask_for_mask(const ModelCommand& command, const pipeline::Source& source) {
  if (!source.image || !command.lumen.branches.empty() || !may_be_mask(*source.image)) return;
  throw InvalidInput(
      own_name(command.input.input) +
      ": an image needs the branches to model, --branch x,y,z:x,y,z for each; if it is a mask of "
      "vessels, say so by --mask");
}

Job job_of(const ModelCommand& command, const core::TaskContext& task) {
  Job job;
  apply(command.mesh, job.options);  // what does not go together is told before anything is read
  if (command.builtin) {
    job.options.clip.planes = placed_planes(command.mesh, "lps", nullptr);
    take_builtin(command, job, task);
  } else {
    task.set_stage("reading");
    job.source = pipeline::load(command.input.input, source_options(command.input), task);
    ask_for_mask(command, job.source);
    const imaging::Geometry* grid = job.source.image  ? &job.source.image->geometry
                                    : job.source.mask ? &job.source.mask->geometry
                                                      : nullptr;
    const SeedFrame frame = seed_frame(command.input, job.source, command.ends.seed_units);
    apply(command.lumen, frame, job.options);
    apply(command.ends, frame, job.options);
    job.options.clip.planes = placed_planes(command.mesh, command.input.coords, grid);
    apply_size_array(command.mesh, command.input, job.source.unit_mm, job.options);
  }
  job.key = {"model",
             {{"input", job.source.sha256}},
             pipeline::parameters_json(job.options, source_options(command.input))};
  if (job.options.sizing.array) job.key.inputs["size_array"] = core::sha256(command.mesh.size_array);
  return job;
}

void print(const pipeline::Model& model, const std::optional<pipeline::TruthErrors>& truth) {
  const auto& surface = model.meshed.quality.surface;
  const auto& volume = model.meshed.quality.volume;
  const std::string prisms =
      volume.prisms.count > 0 ? " and " + std::to_string(volume.prisms.count) + " prisms" : "";
  std::printf(
      "%zu vessels, %zu triangles (least angle %.1f degrees), %zu tetrahedra%s (least dihedral %.1f "
      "degrees)\n",
      model.meshed.centerlines.tree.vessels.size(), surface.triangles, surface.min_angle_deg,
      volume.tetrahedra.count, prisms.c_str(), pipeline::least_dihedral_deg(volume));
  if (!truth) return;
  std::printf(
      "against the truth: lumen %.3f mm off in the mean, radius %.1f %% in the median, %.1f %% in the "
      "throat\n",
      truth->lumen.msd_mm, 100.0 * truth->axis.radius_median_relative, 100.0 * truth->throat_relative);
}

/// What was made before it failed is kept.
pipeline::Model built(const ModelCommand& command, pipeline::Source source,
                      const pipeline::ModelOptions& options, const core::TaskContext& task) {
  KeptResults kept(command.keep, command.output);
  geometry::TriMesh found;
  geometry::VesselTree axes;
  kept.add("lumen.vtp", [&](const std::filesystem::path& file) {
    if (!found.triangles.empty()) io::write_surface(file, found);
  });
  kept.add("centerlines.vtp", [&](const std::filesystem::path& file) {
    if (!axes.vessels.empty()) io::write_centerlines(file, axes);
  });
  EndsNotCutPicture ends(kept);
  return kept.guard([&] {
    pipeline::LumenWithAxes lumen =
        pipeline::build_lumen(std::move(source), options, task.sub(0.0, 0.45), &found);
    axes = lumen.axes;
    try {
      warn_of(pipeline::forecast_model(lumen, options, task.sub(0.45, 0.47)).forecast, true, true);
    } catch (const GeometryError& error) {  // a forecast is a warning: the model itself may still succeed
      core::log_warning(std::string("the mesh cannot be foretold: ") + error.what());
    }
    return ends.guard(found, axes,
                      [&] { return pipeline::mesh_model(std::move(lumen), options, task.sub(0.47, 1.0)); });
  });
}

/// A mask of vessels finds its own ends; with places given it is one lumen between them.
bool takes_vessels_of_mask(const ModelCommand& command) {
  const bool placed =
      !command.lumen.branches.empty() || !command.ends.source.empty() || !command.ends.targets.empty();
  const MaskOptions& mask = command.of_mask;
  const bool told = mask.mask || !mask.labels.empty() || !mask.image.empty();
  if (placed && told)
    throw UsageError(
        "--mask, --label and --image take all vessels of a mask, whose ends are found; leave out --branch, "
        "--source and --target");
  return !command.builtin && !placed && (mask.mask || holds_labels(command.input.input));
}

void print_report(const std::filesystem::path& folder) {
  std::fputs(core::read_file(folder / "report.json").c_str(), stdout);
}

}  // namespace

ExitCode run_model(const ModelCommand& command, const core::TaskContext& task) {
  const auto start = Clock::now();
  if (command.builtin != command.input.input.empty())
    throw UsageError("`ostia model` needs either an input or --builtin");
  if (takes_vessels_of_mask(command))
    return mesh_mask(
        {command.input.input, command.of_mask.image, command.of_mask.labels, command.of_mask.mask},
        {command.mesh, command.input.coords, command.output, command.json}, {}, task);
  pipeline::require_free_folder(command.output);
  Job job = job_of(command, task.sub(0.0, 0.1));
  if (const auto code = pipeline::already_done(command.output, job.key)) {
    core::log_info("done already with the same input and parameters; nothing to do");
    if (command.json) print_report(command.output);
    return *code;
  }
  const core::TaskContext building = task.sub(0.1, 0.85);
  const pipeline::Model model = built(command, std::move(job.source), job.options, building);
  for (const std::string& warning : model.warnings) core::log_warning(warning);
  std::optional<pipeline::TruthErrors> truth;
  if (job.builtin) {
    task.set_stage("comparison with the truth");
    truth = pipeline::compare_with_truth(*job.builtin, model, task.sub(0.85, 0.9));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const ExitCode code = pipeline::write_model_folder(command.output, model, job.options, job.key, truth,
                                                     seconds, task.sub(0.9, 1.0));
  task.set_progress(1.0);
  tell_case(job.options.volume, command.output);
  if (command.json) {
    print_report(command.output);
  } else {
    print(model, truth);
  }
  if (code == ExitCode::quality_failed)
    core::log_warning("quality control failed, a person must look: " +
                      model.meshed.quality.verdict.summary());
  return code;
}

}  // namespace ostia::app
