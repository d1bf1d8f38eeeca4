#include "motion/motion.h"
#include "motion/motion_input.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/pipeline/motion_report.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

geometry::VesselTree tree_in(const fs::path& path) {
  if (path.extension() != ".ostia") return io::read_centerlines(path);
  return session::CaseFile::open(path, session::OpenMode::read_only).model()->tree;
}

analysis::MotionMeasureOptions options_of(const MotionMeasureCommand& c) {
  if (!std::isfinite(c.rr_seconds)) throw UsageError("--rr is the length of the cycle in seconds, a number");
  analysis::MotionMeasureOptions options;
  options.rr_s = c.rr_seconds;
  if (c.reach_mm) options.reach_mm = *c.reach_mm;
  if (c.rest_mm) options.rest_mm = *c.rest_mm;
  analysis::validate(options);
  return options;
}

pipeline::JobKey job_of(const MotionMeasureCommand& c, const analysis::MotionMeasureOptions& options) {
  const Json parameters{{"times", c.times},
                        {"rr_s", options.rr_s},
                        {"reach_mm", options.reach_mm},
                        {"rest_mm", options.rest_mm}};
  pipeline::JobKey key{"motion measure", {}, parameters.dump()};
  key.inputs["motion"] = core::sha256_file(motion_path(c.motion));
  key.inputs["centerlines"] = core::sha256_file(c.input);
  return key;
}

/// The farthest that a measure goes from what it is at the template.
double farthest(const Json& measure, double from) {
  double most = 0.0;
  for (const Json& value : measure["values"])
    if (value.is_number()) most = std::max(most, std::abs(value.get<double>() - from));
  return most;
}

void print_measures(const Json& result) {
  for (const Json& branch : result["branches"]) {
    const Json& m = branch["measures"];
    std::printf("%s: %.1f mm long, moves up to %.1f mm, at most %.0f mm/s; length changes by up to %.1f %%\n",
                branch["name"].get<std::string>().c_str(), branch["length_mm"].get<double>(),
                farthest(m["displacement_max"], 0.0), farthest(m["speed_max"], 0.0),
                100.0 * farthest(m["stretch"], 1.0));
  }
  for (const Json& rest : result["rests"])
    std::printf("at rest from %.0f to %.0f %% of the cycle, %.0f ms\n", rest["from_percent"].get<double>(),
                rest["to_percent"].get<double>(), rest["duration_ms"].get<double>());
}

void measure(const MotionMeasureCommand& c, const analysis::MotionMeasureOptions& options,
             const pipeline::JobKey& key, const core::TaskContext& task) {
  const auto start = Clock::now();
  task.set_stage("reading");
  const motion::MovingCage cage(io::read_cage_motion(motion_path(c.motion)).motion);
  const geometry::VesselTree tree = tree_in(c.input);
  task.set_stage("measuring");
  const analysis::TreeMotion motion = naming(c.input, [&] {
    const analysis::MovingTree moving =
        analysis::carried_tree(tree, cage, analysis::even_phases(c.times), 0.5, task.sub(0.1, 0.3));
    return analysis::measure_motion(moving, options, task.sub(0.3, 0.7));
  });
  for (const std::string& warning : motion.warnings) core::log_warning(warning);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  pipeline::write_motion_report(c.output, motion, key, seconds, task.sub(0.7, 1.0));
}

}  // namespace

ExitCode run_motion_measure(const MotionMeasureCommand& c, const core::TaskContext& task) {
  const analysis::MotionMeasureOptions options = options_of(c);
  pipeline::require_free_folder(c.output);
  const pipeline::JobKey key = job_of(c, options);
  if (pipeline::already_done(c.output, key))
    core::log_info("done already with the same motion, axes and parameters; nothing to do");
  else
    measure(c, options, key, task);
  const std::string result = core::read_file(c.output / "measures.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_measures(Json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
