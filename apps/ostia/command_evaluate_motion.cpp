#include "evaluate.h"

#include "ostia/core/files.h"
#include "ostia/evaluation/motion_error.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::app {
namespace {

using evaluation::PointMotion;

/// docs/schemas/motion.schema.json
PointMotion motion_from(const std::filesystem::path& path) {
  try {
    const Json all = Json::parse(core::read_file(path));
    if (all.at("v") != 1 || all.at("unit") != "mm" || all.at("axes") != "LPS")
      throw InvalidInput(path.string() + ": v must be 1, unit mm, axes LPS");
    PointMotion motion;
    for (const Json& phase : all.at("phases")) {
      motion.percent.push_back(phase.at("percent").get<double>());
      motion.phases.emplace_back();
      for (const Json& p : phase.at("points")) {
        if (p.size() != 3) throw InvalidInput(path.string() + ": phases.points: a point is [x, y, z]");
        motion.phases.back().emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
      }
    }
    return motion;
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(path.string() + ": no file of moving points: " + error.what() +
                       "; see docs/schemas/motion.schema.json");
  }
}

}  // namespace

ExitCode run_evaluate_motion(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  const PointMotion reference = motion_from(command.reference), result = motion_from(command.result);
  const evaluation::MotionError error = evaluation::compare_motion(reference, result);
  Json out{{"v", 1},
           {"kind", "motion"},
           {"mean_mm", error.mean_mm},
           {"rms_mm", error.rms_mm},
           {"max_mm", error.max_mm},
           {"amplitude_mm", error.amplitude_mm},
           {"relative", std::isfinite(error.relative) ? Json(error.relative) : Json(nullptr)}};
  out["phases"] = Json::array();
  for (const evaluation::PhaseError& p : error.phases)
    out["phases"].push_back(
        {{"percent", p.percent}, {"mean_mm", p.mean_mm}, {"rms_mm", p.rms_mm}, {"max_mm", p.max_mm}});
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
