#include "input/input_digest.h"
#include "motion/motion.h"
#include "motion/motion_fit_report.h"
#include "motion/motion_images.h"
#include "motion/motion_input.h"
#include "motion/phase_surface.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using pipeline::MotionFit;

constexpr const char* template_name = "template.vtp";

pipeline::MotionFitOptions options_of(const MotionFitCommand& c) {
  if (!std::isfinite(c.template_percent))
    throw UsageError("--template-phase is percent of the cycle, a number");
  pipeline::MotionFitOptions options;
  options.template_phase = c.template_percent >= 100.0 ? 0.0 : c.template_percent / 100.0;
  if (c.method == "gradient-descent") options.method = pipeline::MotionMethod::gradient_descent;
  options.registration.depth = c.depth;
  if (!c.weights.empty() && c.weights.size() != 1 && c.weights.size() != 3)
    throw UsageError("--weights takes length,area,volume or one number for all three, not " +
                     std::to_string(c.weights.size()));
  if (!c.weights.empty())
    options.registration.energy = {c.weights.front(), c.weights[c.weights.size() / 2], c.weights.back()};
  motion::validate(options.registration);
  return options;
}

pipeline::JobKey job_of(const MotionFitCommand& c, const pipeline::MotionFitOptions& options,
                        const std::vector<PhaseFile>& files, const core::TaskContext& task) {
  const auto& energy = options.registration.energy;
  const Json parameters{{"template_percent", c.template_percent},
                        {"depth", c.depth},
                        {"weights", {energy.length, energy.area, energy.volume}},
                        {"method", c.method},
                        {"frames", c.frames},
                        {"surface", c.surface},
                        {"by", c.by},
                        {"units", c.units}};
  pipeline::JobKey key{"motion fit", {}, parameters.dump()};
  for (const PhaseFile& one : files)
    key.inputs["phase " + pipeline::percent_text(one.phase)] = digest_of(one, task);
  if (!c.shape.empty()) key.inputs["template"] = digest_of(c.shape);
  return key;
}

MaskSurface how_of(const MotionFitCommand& c) {
  return c.surface == "poisson" ? MaskSurface::poisson : MaskSurface::isosurface;
}

/// Poisson reconstruction is asked for where nothing is a mask: better said than left undone.
void require_mask(const MotionFitCommand& c, const std::vector<PhaseFile>& files) {
  const auto is_volume = [](const fs::path& path) { return is_image_name(path.filename().string()); };
  const bool phases_are_masks = c.shape.empty() || !are_images(files);
  if (how_of(c) == MaskSurface::isosurface || is_volume(c.shape) ||
      (phases_are_masks &&
       std::ranges::any_of(files, [&](const PhaseFile& one) { return is_volume(one.file); })))
    return;
  throw UsageError("--surface poisson is how masks get their surface, and there is no mask in " +
                   c.input.string() + "; leave it out");
}

/// The phases' surfaces, and how they were found where they come from images.
struct Phases {
  std::vector<pipeline::PhaseSurface> surfaces;
  std::vector<pipeline::ImagePhase> found;  ///< none where surfaces were read
  std::vector<std::string> warnings;
};

/// It would change nothing.
void require_images(const MotionFitCommand& c, const std::vector<PhaseFile>& files) {
  if (c.by == "cage" || (!c.shape.empty() && are_images(files))) return;
  throw UsageError("--by says what carries a --template through images; " +
                   std::string(c.shape.empty() ? "no template was given" : "the phases are none"));
}

Phases phases_of(const MotionFitCommand& c, const pipeline::MotionFitOptions& options,
                 const std::vector<PhaseFile>& files, const core::TaskContext& task) {
  const bool images = !c.shape.empty() && are_images(files);
  if (!images) {
    Phases phases{read_phases(files, c.units, how_of(c), task.sub(0.0, 0.2)), {}, {}};
    if (!c.shape.empty())
      put_template(phase_surface(c.shape, c.units, how_of(c), task), options.template_phase,
                   own_name(c.shape), phases.surfaces);
    return phases;
  }
  pipeline::ImagePhasesOptions how;
  if (c.by == "b-splines") how.carrier = pipeline::ImageCarrier::b_splines;
  how.template_phase = options.template_phase;
  how.depth = options.registration.depth;
  how.margin = options.registration.margin;
  const geometry::TriMesh shape = phase_surface(c.shape, c.units, how_of(c), task.sub(0.0, 0.1));
  pipeline::ImagePhases all = phases_in_images(files, shape, how, task);
  return {std::move(all.surfaces), std::move(all.found), std::move(all.warnings)};
}

/// The lumens that were found in images, named so that they are phases themselves.
void write_lumens(const fs::path& folder, const std::vector<pipeline::PhaseSurface>& surfaces) {
  fs::create_directory(folder);
  for (const pipeline::PhaseSurface& one : surfaces) {
    const std::string percent = pipeline::percent_text(one.phase);
    if (!one.surface.triangles.empty())
      io::write_surface(folder / ("lumen_" + percent.substr(0, percent.find(' ')) + ".vtp"), one.surface);
  }
}

void write(const fs::path& output, const MotionFit& fit, const Phases& phases, const pipeline::JobKey& key,
           ExitCode code, const Clock::time_point& start) {
  core::StagedFolder staged(output);
  const fs::path folder = staged.temporary();
  const Json report = motion_fit_report(fit, phases.found);
  io::write_surface(folder / template_name, fit.template_shape);
  io::write_cage_motion(folder / "motion.json", {fit.motion, template_name});
  if (!phases.found.empty()) write_lumens(folder / "lumen", phases.surfaces);
  core::write_file(folder / "report.json", report.dump(2) + "\n");
  core::write_file(folder / "report.csv", motion_fit_table(report));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  Json quality = report;
  quality.erase("phases");
  pipeline::write_manifest(folder, {key, code, seconds, fit.warnings, quality.dump()});
  staged.commit();
}

}  // namespace

ExitCode run_motion_fit(const MotionFitCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const pipeline::MotionFitOptions options = options_of(c);
  pipeline::require_free_folder(c.output);
  task.set_stage("reading");
  const std::vector<PhaseFile> files =
      phase_files(c.input, c.frames, c.shape.empty() ? PhaseContent::surfaces : PhaseContent::images, task);
  require_mask(c, files);
  require_images(c, files);
  const pipeline::JobKey key = job_of(c, options, files, task);
  std::optional<ExitCode> code = pipeline::already_done(c.output, key);
  if (code) {
    core::log_info("done already with the same phases and parameters; nothing to do");
  } else {
    Phases phases = phases_of(c, options, files, task.sub(0.0, 0.5));
    for (const std::string& warning : phases.warnings) core::log_warning(warning);
    MotionFit fit = pipeline::fit_motion(phases.surfaces, options, task.sub(0.5, 0.95));
    for (const std::string& warning : fit.warnings) core::log_warning(warning);
    fit.warnings.insert(fit.warnings.begin(), phases.warnings.begin(), phases.warnings.end());
    task.throw_if_cancelled();
    task.set_stage("writing");
    code = verdict_of(fit);
    write(c.output, fit, phases, key, *code, start);
  }
  const std::string report = core::read_file(c.output / "report.json");
  if (c.json)
    std::fputs(report.c_str(), stdout);
  else
    print_motion_fit(Json::parse(report));
  task.set_progress(1.0);
  return *code;
}

}  // namespace ostia::app
