#include "evaluate/evaluate.h"
#include "motion/motion_input.h"

#include "ostia/core/files.h"
#include "ostia/evaluation/motion_error.h"
#include "ostia/evaluation/surface_motion.h"
#include "ostia/io/surface_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::app {
namespace fs = std::filesystem;
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

Json motion_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// The surfaces of a folder by phase.
std::map<std::string, fs::path> phases_in(const fs::path& folder) {
  std::map<std::string, fs::path> phases;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !io::is_surface_file(entry.path())) continue;
    const auto [place, fresh] = phases.emplace(phase_of(entry.path().stem().string()), entry.path());
    if (!fresh)
      throw InvalidInput(folder.string() + ": " + place->second.filename().string() + " and " +
                         entry.path().filename().string() + " are both phase " + place->first);
  }
  if (phases.empty())
    throw InvalidInput(folder.string() +
                       " holds no surface (.vtp .stl .ply .obj): one file a phase is expected");
  return phases;
}

void require_phases(const std::map<std::string, fs::path>& phases, const fs::path& where,
                    const std::map<std::string, fs::path>& like) {
  for (const auto& [phase, path] : like)
    if (!phases.contains(phase))
      throw InvalidInput(where.string() + " has no phase " + phase + ": nothing stands against " +
                         path.string());
}

Json cycle_json(const evaluation::CycleFigures& cycle) {
  return {{"path_mm", motion_number(cycle.path_mm)},
          {"amplitude_mm", motion_number(cycle.amplitude_mm)},
          {"closing_ratio", motion_number(cycle.closing_ratio)}};
}

/// Folders of surfaces, one a phase.
Json surfaces_compared(const EvaluateCommand& command, const core::TaskContext& task) {
  const auto of_reference = phases_in(command.reference), of_result = phases_in(command.result);
  require_phases(of_result, command.result, of_reference);
  require_phases(of_reference, command.reference, of_result);
  std::vector<std::string> names;
  for (const auto& one : of_reference) names.push_back(one.first);
  std::sort(names.begin(), names.end(), evaluation::natural_less);
  evaluation::SurfaceMotion reference, result;
  reference.names = result.names = names;
  for (const std::string& name : names) {
    reference.phases.push_back(surface_from(of_reference.at(name), command.units));
    result.phases.push_back(surface_from(of_result.at(name), command.units));
  }
  const evaluation::SurfaceMotionError e = evaluation::compare_surface_motion(
      reference, result, {.sample_mm = command.sample_mm, .resolution_mm = command.resolution_mm}, task);
  Json out{{"v", 1},
           {"kind", "motion"},
           {"method", "surfaces"},
           {"corresponding", e.corresponding},
           {"msd_mm", e.msd_mm},
           {"hausdorff_mm", e.max_sd_mm},
           {"dice", motion_number(e.dice)},
           {"displacement_mm", motion_number(e.displacement_mm)},
           {"path_difference_mm", motion_number(e.path_difference_mm)},
           {"reference", cycle_json(e.reference)},
           {"result", cycle_json(e.result)}};
  out["phases"] = Json::array();
  for (const evaluation::SurfacePhaseError& p : e.phases)
    out["phases"].push_back({{"phase", p.name},
                             {"msd_mm", p.msd_mm},
                             {"hausdorff_mm", p.max_sd_mm},
                             {"dice", motion_number(p.dice)},
                             {"displacement_mm", motion_number(p.displacement_mm)},
                             {"max_displacement_mm", motion_number(p.max_displacement_mm)}});
  return out;
}

}  // namespace

ExitCode run_evaluate_motion(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  const bool folders = fs::is_directory(command.reference);
  if (folders != fs::is_directory(command.result))
    throw InvalidInput("cannot compare " + command.reference.string() + " and " + command.result.string() +
                       ": one is a folder of surfaces and the other is not");
  if (folders) {
    const Json out = surfaces_compared(command, task);
    task.set_progress(1.0);
    return finish(command, out);
  }
  const PointMotion reference = motion_from(command.reference), result = motion_from(command.result);
  const evaluation::MotionError error = evaluation::compare_motion(reference, result);
  Json out{{"v", 1},
           {"kind", "motion"},
           {"method", "points"},
           {"mean_mm", error.mean_mm},
           {"rms_mm", error.rms_mm},
           {"max_mm", error.max_mm},
           {"amplitude_mm", error.amplitude_mm},
           {"relative", motion_number(error.relative)}};
  out["phases"] = Json::array();
  for (const evaluation::PhaseError& p : error.phases)
    out["phases"].push_back(
        {{"percent", p.percent}, {"mean_mm", p.mean_mm}, {"rms_mm", p.rms_mm}, {"max_mm", p.max_mm}});
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
