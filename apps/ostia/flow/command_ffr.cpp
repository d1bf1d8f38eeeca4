// `ostia ffr`: pressure and flow along a coronary tree, from its form alone.

#include "flow/ffr.h"
#include "options/validators.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/io/centerline_file.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_file.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_report.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

session::PressureReportOptions options_of(const FfrCommand& c) {
  session::PressureReportOptions options;
  if (!c.conditions.empty()) {
    try {
      options.conditions = hemodynamics::conditions_of_json(core::read_file(c.conditions));
    } catch (const InvalidInput& error) {
      throw InvalidInput(c.conditions.string() + ": " + error.what());
    }
  }
  const auto take = [](const std::optional<double>& told, double& value) {
    if (told) value = *told;
  };
  take(c.systolic_mmhg, options.conditions.systolic_mmhg);
  take(c.diastolic_mmhg, options.conditions.diastolic_mmhg);
  take(c.heart_rate_bpm, options.conditions.heart_rate_bpm);
  if (c.lv_mass_g) options.conditions.lv_mass_g = c.lv_mass_g;
  if (c.rest_flow_ml_min) options.conditions.rest_flow_ml_min = c.rest_flow_ml_min;
  options.reading.behind_mm = c.behind_mm;
  options.model.junctions =
      c.junctions == "none" ? hemodynamics::JunctionLaw::none : hemodynamics::JunctionLaw::unified;
  options.pulse = c.pulse;
  options.unusual = c.unusual;
  hemodynamics::validate(options.conditions, true);  // what has no meaning is never taken
  try {
    hemodynamics::validate(options.conditions, options.unusual);
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string(error.what()) + (c.unusual ? "" : "; --unusual takes it as it is"));
  }
  hemodynamics::validate(options.reading);
  return options;
}

pipeline::JobKey job_of(const FfrCommand& c, const session::PressureReportOptions& options) {
  const nlohmann::json parameters = {
      {"conditions", nlohmann::json::parse(hemodynamics::conditions_json(options.conditions))},
      {"behind_mm", c.behind_mm},
      {"junctions", c.junctions},
      {"pulse", c.pulse},
      {"unusual", c.unusual}};
  return {"ffr", {{"input", core::sha256_file(c.input)}}, parameters.dump()};
}

session::PressureTree tree_of(const FfrCommand& c, const core::TaskContext& task) {
  task.set_stage("reading");
  if (c.input.extension() != ".ostia") {
    const geometry::VesselTree tree = io::read_centerlines(c.input);
    task.set_stage("sections");
    return session::pressure_tree(tree, {}, task);
  }
  const session::CaseFile file = session::CaseFile::open(c.input, session::OpenMode::read_only);
  const lumen::LumenModel& model = *file.model();
  task.set_stage("solving");
  const analysis::SurfaceOfVessel surfaces = session::solved_surfaces(model, task.sub(0.0, 0.4));
  task.set_stage("sections");
  return session::pressure_tree(model, surfaces, {}, task.sub(0.4, 1.0));
}

std::string number_text(const nlohmann::json& value, int decimals) {
  return value.is_null() ? std::string("-") : core::fixed_text(value.get<double>(), decimals);
}

void print(const nlohmann::json& result) {
  std::printf("mean aortic pressure %s mmHg; the tree asks for %s ml/min at rest (by %s)\n",
              number_text(result["aortic_mmhg"], 0).c_str(),
              number_text(result["flow"]["asked_ml_min"], 0).c_str(),
              result["flow"]["source"].get<std::string>().c_str());
  for (const auto& lesion : result["lesions"]) {
    std::string line = lesion["name"].get<std::string>() + " " + lesion["vessel_name"].get<std::string>() +
                       " at " + number_text(lesion["throat"]["s_mm"], 1) + " mm: ";
    if (lesion["occluded"].get<bool>())
      line += "occluded";
    else
      line += "FFR " + number_text(lesion["ffr"], 2) + " " + number_text(lesion["behind_mm"], 0) +
              " mm behind, of which the lesion " + number_text(lesion["delta_ffr"], 2) + "; at rest " +
              number_text(lesion["resting_pd_pa"], 2);
    if (lesion.contains("pulse")) line += ", iFR " + number_text(lesion["pulse"]["wave_free_ratio"], 2);
    std::printf("%s\n", line.c_str());
  }
  for (const auto& outlet : result["outlets"])
    std::printf("end of %s: FFR %s, %s ml/min, %s at rest\n", outlet["name"].get<std::string>().c_str(),
                number_text(outlet["ffr"], 2).c_str(), number_text(outlet["hyperaemic_ml_min"], 0).c_str(),
                number_text(outlet["rest_ml_min"], 0).c_str());
  std::printf("%s\n", result["research_use"].get<std::string>().c_str());
}

}  // namespace

ExitCode run_ffr(const FfrCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const session::PressureReportOptions options = options_of(c);
  pipeline::require_free_folder(c.output);
  if (!fs::is_regular_file(c.input))
    throw IoError("cannot read " + c.input.string() + ": there is no such file");
  const pipeline::JobKey job = job_of(c, options);
  if (pipeline::already_done(c.output, job)) {
    core::log_info("done already with the same input and parameters; nothing to do");
  } else {
    session::PressureTree tree = tree_of(c, task.sub(0.0, 0.9));
    const session::PressureReport report =
        session::make_pressure_report(std::move(tree), options, task.sub(0.9, 0.98));
    for (const std::string& warning : report.warnings) core::log_warning(warning);
    task.set_stage("writing");
    session::write_pressure_report(c.output, report, job,
                                   std::chrono::duration<double>(Clock::now() - start).count());
  }
  const std::string result = core::read_file(c.output / "ffr.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

void define_ffr(CLI::App& app, FfrCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* ffr = app.add_subcommand("ffr",
                                     "Pressure and flow along a coronary tree, FFR behind each narrowing, "
                                     "computed from its form; for research");
  ffr->footer(
      "Example:\n  ostia ffr heart.ostia -o pressure\n"
      "  ostia ffr lines.vtp -o pressure --systolic 135 --diastolic 85 --lv-mass 140 --pulse");
  ffr->fallthrough();
  ffr->add_option("INPUT", c.input, "Case, or a tree of vessels with radii (.vtp, .vtk, .swc, .csv, .gxl)")
      ->required();
  ffr->add_option("-o,--output", c.output, "Folder that is made")->required();
  ffr->add_option("--systolic", c.systolic_mmhg, "Systolic pressure by cuff, mmHg");
  ffr->add_option("--diastolic", c.diastolic_mmhg, "Diastolic pressure by cuff, mmHg");
  ffr->add_option("--heart-rate", c.heart_rate_bpm, "Beats a minute, for --pulse");
  ffr->add_option("--lv-mass", c.lv_mass_g,
                  "Mass of the left ventricle, g; left out: flow goes by the vessels' calibre");
  ffr->add_option("--rest-flow", c.rest_flow_ml_min,
                  "Flow of the whole tree at rest, ml/min, where it is known");
  ffr->add_option("--conditions", c.conditions,
                  "Any input, as JSON: {\"venous_mmhg\": 7}, or a conditions.json");
  ffr->add_option("--behind", c.behind_mm, "Where a narrowing's FFR is read, mm behind its end")
      ->check(CLI::Range(0.0, 60.0));
  ffr->add_option("--junctions", c.junctions,
                  "Losses at forks: unified (Mynard and Valen-Sendstad 2015), none")
      ->check(CLI::IsMember({"unified", "none"}));
  ffr->add_flag("--pulse", c.pulse, "Also over the beat at rest: Pd/Pa and iFR");
  ffr->add_flag("--unusual", c.unusual, "Take pressures and flows beyond physiology");
  ffr->add_flag("--json", c.json, "ffr.json on standard output");
  ffr->callback([&] { run = [&](const core::TaskContext& task) { return run_ffr(c, task); }; });
}

}  // namespace ostia::app
