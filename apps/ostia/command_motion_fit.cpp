#include "input_digest.h"
#include "motion.h"
#include "motion_images.h"
#include "motion_input.h"
#include "refusal.h"

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
using geometry::PhaseOrigin;
using pipeline::MotionFit;
using pipeline::PhaseFit;

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
                        {"units", c.units}};
  pipeline::JobKey key{"motion fit", {}, parameters.dump()};
  for (const PhaseFile& one : files)
    key.inputs["phase " + pipeline::percent_text(one.phase)] = digest_of(one, task);
  if (!c.shape.empty()) key.inputs["template"] = digest_of(c.shape);
  return key;
}

/// The phases' surfaces, and how they were found where they come from images.
struct Phases {
  std::vector<pipeline::PhaseSurface> surfaces;
  std::vector<pipeline::ImagePhase> found;  ///< none where surfaces were read
  std::vector<std::string> warnings;
};

Phases phases_of(const MotionFitCommand& c, const pipeline::MotionFitOptions& options,
                 const std::vector<PhaseFile>& files, const core::TaskContext& task) {
  const bool images = !c.shape.empty() && are_images(files);
  if (!images) {
    Phases phases{read_phases(files, c.units, task.sub(0.0, 0.2)), {}, {}};
    if (!c.shape.empty())
      put_template(phase_surface(c.shape, c.units), options.template_phase, own_name(c.shape),
                   phases.surfaces);
    return phases;
  }
  pipeline::ImagePhasesOptions how;
  how.template_phase = options.template_phase;
  how.depth = options.registration.depth;
  how.margin = options.registration.margin;
  const geometry::TriMesh shape = phase_surface(c.shape, c.units);
  pipeline::ImagePhases all = phases_in_images(files, shape, how, task);
  return {std::move(all.surfaces), std::move(all.found), std::move(all.warnings)};
}

const char* origin_name(PhaseOrigin origin) {
  switch (origin) {
    case PhaseOrigin::at_rest:
      return "at_rest";
    case PhaseOrigin::bridged:
      return "bridged";
    default:
      return "fitted";
  }
}

Json phase_json(const PhaseFit& one, const std::vector<pipeline::ImagePhase>& images) {
  Json out{{"percent", io::percent_of(one.phase)},
           {"origin", origin_name(one.origin)},
           {"why", one.why.empty() ? Json(nullptr) : Json(one.why)},
           {"stiffness", one.stiffness},
           {"rounds", one.report.rounds},
           {"paired_share", one.report.paired_share},
           {"mean_distance_mm", one.report.mean_distance_mm},
           {"least_jacobian", one.report.least_jacobian},
           {"self_intersections", one.report.self_intersections},
           {"source_self_intersections", one.report.source_self_intersections}};
  for (const pipeline::ImagePhase& image : images)
    if (image.phase == one.phase)
      out["image"] = {{"likeness", image.likeness},
                      {"inside_share", image.inside_share},
                      {"wall_shift_mm", image.wall_shift_mm}};
  return out;
}

/// Of all phases together.
struct Sums {
  std::size_t fitted = 0, bridged = 0, gaps = 0, new_intersections = 0;
  double distance = 0.0, least_share = 1.0, least_jacobian = 1.0;
};

Sums sums_of(const MotionFit& fit) {
  Sums sums;
  for (const PhaseFit& one : fit.phases) {
    const auto& r = one.report;
    sums.least_jacobian = std::min(sums.least_jacobian, r.least_jacobian);
    if (one.origin == PhaseOrigin::bridged) {
      ++(one.gap ? sums.gaps : sums.bridged);
    } else if (one.origin == PhaseOrigin::fitted) {
      ++sums.fitted;
      sums.distance += r.mean_distance_mm;
      sums.least_share = std::min(sums.least_share, r.paired_share);
      if (r.self_intersections > r.source_self_intersections)
        sums.new_intersections += r.self_intersections - r.source_self_intersections;
    }
  }
  if (sums.fitted > 0) sums.distance /= static_cast<double>(sums.fitted);
  return sums;
}

Json report_of(const MotionFit& fit, const std::vector<pipeline::ImagePhase>& images) {
  const Sums sums = sums_of(fit);
  Json out{{"v", 1},
           {"kind", "motion-fit"},
           {"template_percent", io::percent_of(fit.motion.template_phase)},
           {"template_points", fit.template_shape.points.size()},
           {"template_triangles", fit.template_shape.triangles.size()},
           {"cells", fit.motion.grid.cells},
           {"control_points", fit.motion.grid.point_count()},
           {"fitted", sums.fitted},
           {"bridged", sums.bridged},
           {"gaps", sums.gaps},
           {"mean_distance_mm", sums.distance},
           {"least_paired_share", sums.least_share},
           {"least_jacobian", sums.least_jacobian},
           {"new_self_intersections", sums.new_intersections},
           {"phases", Json::array()}};
  for (const PhaseFit& one : fit.phases) out["phases"].push_back(phase_json(one, images));
  return out;
}

std::string report_table(const Json& report) {
  const std::vector<std::string> columns{"percent",
                                         "origin",
                                         "stiffness",
                                         "rounds",
                                         "paired_share",
                                         "mean_distance_mm",
                                         "least_jacobian",
                                         "self_intersections",
                                         "source_self_intersections"};
  std::string text;
  for (const std::string& column : columns) text += (text.empty() ? "" : ",") + column;
  for (const Json& phase : report["phases"]) {
    std::string line;
    for (const std::string& column : columns) {
      const Json& value = phase[column];
      line += (line.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
    }
    text += "\n" + line;
  }
  return text + "\n";
}

/// Gaps are as they are; all else that was bridged, inverted or intersects is for a person to look at.
ExitCode verdict(const Sums& sums) {
  const bool fine = sums.bridged == 0 && sums.least_jacobian > 0.0 && sums.new_intersections == 0;
  return fine ? ExitCode::ok : ExitCode::quality_failed;
}

void print(const Json& report) {
  std::printf("%zu phases: %d fitted to %s %% at %d control points, %d bridged, %d gaps\n",
              report["phases"].size(), report["fitted"].get<int>(), report["template_percent"].dump().c_str(),
              report["control_points"].get<int>(), report["bridged"].get<int>(), report["gaps"].get<int>());
  std::printf("mean distance %.3f mm, least paired share %.3f, least Jacobian %.3f, %d new intersections\n",
              report["mean_distance_mm"].get<double>(), report["least_paired_share"].get<double>(),
              report["least_jacobian"].get<double>(), report["new_self_intersections"].get<int>());
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
  const Json report = report_of(fit, phases.found);
  io::write_surface(folder / template_name, fit.template_shape);
  io::write_cage_motion(folder / "motion.json", {fit.motion, template_name});
  if (!phases.found.empty()) write_lumens(folder / "lumen", phases.surfaces);
  core::write_file(folder / "report.json", report.dump(2) + "\n");
  core::write_file(folder / "report.csv", report_table(report));
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
    code = verdict(sums_of(fit));
    write(c.output, fit, phases, key, *code, start);
  }
  const std::string report = core::read_file(c.output / "report.json");
  if (c.json)
    std::fputs(report.c_str(), stdout);
  else
    print(Json::parse(report));
  task.set_progress(1.0);
  return *code;
}

}  // namespace ostia::app
