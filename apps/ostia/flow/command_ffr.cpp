// `ostia ffr`: pressure and flow along a coronary tree, from its form alone.

#include "flow/ffr.h"
#include "input/case_image.h"
#include "input/input_digest.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_file.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_report.h"
#include "ostia/session/pressure_wall_spread.h"
#include "ostia/session/pressure_what_if.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// `given` as a file of conditions has it; what is wrong in there is told with the file's name.
template <typename Value>
Value told_in(const fs::path& file, Value (*read)(std::string_view, const Value&), const Value& given) {
  if (file.empty()) return given;
  try {
    return read(core::read_file(file), given);
  } catch (const InvalidInput& error) {
    throw InvalidInput(file.string() + ": " + error.what());
  }
}

/// Trees to be drawn; the walls' spread by an image comes later.
std::optional<hemodynamics::UncertaintyOptions> uncertainty_of(const FfrCommand& c) {
  if (c.uncertainty.empty()) return std::nullopt;
  hemodynamics::UncertaintyOptions options;
  options = told_in(c.conditions, hemodynamics::uncertainty_of_json, options);
  // An option goes before the file, which names a seed where it is a result's.
  if (c.seed) options.seed = *c.seed;
  if (c.uncertainty != usual_trees) options.samples = std::stoi(c.uncertainty);
  if (c.wall_spread_mm) {
    options.wall.radius_sd_mm = *c.wall_spread_mm;
    options.wall.source = "told";
  }
  hemodynamics::validate(options);
  return options;
}

/// `kept`: what the case itself says, before all that is told here.
session::PressureReportOptions options_of(const FfrCommand& c, const session::PressureNotes& kept) {
  session::PressureReportOptions options;
  options.conditions = session::conditions_of(kept);
  options.conditions = told_in(c.conditions, hemodynamics::conditions_of_json, options.conditions);
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
  for (const std::string& format : c.exports) options.exports.push_back(hemodynamics::network_format(format));
  options.pulse = c.pulse;
  options.unusual = c.unusual;
  options.uncertainty = uncertainty_of(c);
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
  nlohmann::json parameters = {
      {"conditions", nlohmann::json::parse(hemodynamics::conditions_json(options.conditions))},
      {"behind_mm", c.behind_mm},
      {"junctions", c.junctions},
      {"export", c.exports},
      {"pulse", c.pulse},
      {"open", c.open},
      {"narrow", c.narrow},
      {"unusual", c.unusual}};
  if (options.uncertainty)
    parameters["uncertainty"] = nlohmann::json::parse(hemodynamics::uncertainty_json(*options.uncertainty));
  std::map<std::string, std::string> inputs{{"input", core::sha256_file(c.input)}};
  if (!c.image.empty()) inputs["image"] = digest_of(c.image);
  return {"ffr", std::move(inputs), parameters.dump()};
}

/// A case, or a tree of lines.
struct FfrInput {
  std::shared_ptr<const lumen::LumenModel> model;  // of a case
  geometry::VesselTree lines;                      // else
  session::PressureNotes notes;
  std::shared_ptr<const imaging::ImageVolume> image;  // of a case, where it is told
  const geometry::VesselTree& tree() const { return model ? model->tree : lines; }
};

FfrInput read_input(const FfrCommand& c, const core::TaskContext& task) {
  const fs::path& path = c.input;
  FfrInput input;
  if (path.extension() != ".ostia") {
    if (!c.image.empty())
      throw InvalidInput(path.string() +
                         " has no walls that an image could tell the spread of; leave out --image");
    input.lines = io::read_centerlines(path);
    return input;
  }
  const session::CaseFile file = session::CaseFile::open(path, session::OpenMode::read_only);
  input.model = file.model();
  input.notes = file.annotations()->pressure;
  options_of(c, input.notes);  // what is wrong with it is said before the image is read
  if (!c.image.empty()) input.image = case_image(c.image, file, task).image;
  return input;
}

/// Those of the case, then those that are told.
std::vector<session::WhatIf> what_ifs_of(const FfrCommand& c, const FfrInput& input) {
  std::vector<session::WhatIf> all = input.notes.what_ifs;
  for (const std::string& text : c.open)
    all.push_back(session::what_if_of_text(text, session::WhatIfKind::open, input.tree()));
  for (const std::string& text : c.narrow)
    all.push_back(session::what_if_of_text(text, session::WhatIfKind::narrow, input.tree()));
  return all;
}

/// With the spread of its walls by the image, where there is one.
session::PressureTree tree_of(const FfrInput& input, session::PressureReportOptions& options,
                              const core::TaskContext& task) {
  if (!input.model) {
    task.set_stage("sections");
    return session::pressure_tree(input.lines, {}, task);
  }
  const lumen::LumenModel& model = *input.model;
  task.set_stage("solving");
  const analysis::SurfaceOfVessel surfaces = session::solved_surfaces(model, task.sub(0.0, 0.4));
  task.set_stage("sections");
  session::PressureTree tree = session::pressure_tree(model, surfaces, {}, task.sub(0.4, 0.8));
  if (input.image && options.uncertainty)
    options.uncertainty->wall = session::wall_spread_of_image(
        tree, model, surfaces, *input.image, options.uncertainty->wall, {}, task.sub(0.8, 1.0));
  return tree;
}

std::string number_text(const nlohmann::json& value, int decimals) {
  return value.is_null() ? std::string("-") : core::fixed_text(value.get<double>(), decimals);
}

/// Where it comes from is told of the inputs that have a say.
void print_uncertainty(const nlohmann::json& lesion) {
  if (lesion["ffr"].is_null()) return;
  std::string line = lesion["name"].get<std::string>() + " in 95 % " + number_text(lesion["ffr"]["low"], 2) +
                     " to " + number_text(lesion["ffr"]["high"], 2) + ", at or below the threshold in " +
                     core::fixed_text(100.0 * lesion["ffr"]["probability"].get<double>(), 0) + " %";
  std::string from;
  if (lesion["sobol"].is_object())
    for (const auto& [group, index] : lesion["sobol"].items())
      if (index["total"].get<double>() >= 0.05)
        from += (from.empty() ? "; by " : ", ") + group + " " +
                core::fixed_text(100.0 * index["total"].get<double>(), 0) + " %";
  std::printf("%s%s\n", line.c_str(), from.c_str());
}

void print_pressures(const nlohmann::json& result) {
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
  if (result.contains("uncertainty"))
    for (const auto& lesion : result["uncertainty"]["lesions"]) print_uncertainty(lesion);
  if (result.contains("what_if"))
    for (const auto& lesion : result["what_if"]["lesions"])
      std::printf("%s as if: FFR %s\n", lesion["name"].get<std::string>().c_str(),
                  number_text(lesion["ffr"], 2).c_str());
  for (const auto& outlet : result["outlets"])
    std::printf("end of %s: FFR %s, %s ml/min, %s at rest\n", outlet["name"].get<std::string>().c_str(),
                number_text(outlet["ffr"], 2).c_str(), number_text(outlet["hyperaemic_ml_min"], 0).c_str(),
                number_text(outlet["rest_ml_min"], 0).c_str());
  std::printf("%s\n", result["research_use"].get<std::string>().c_str());
}

}  // namespace

ExitCode run_ffr(const FfrCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  // What is wrong with it is said before anything is read; a case's own inputs come first.
  if (c.input.extension() != ".ostia") options_of(c, {});
  pipeline::require_free_folder(c.output);
  if (!fs::is_regular_file(c.input))
    throw IoError("cannot read " + c.input.string() + ": there is no such file");
  if (c.input.extension() == ".json" && !io::is_markups_file(c.input)) return run_ffr_network(c, task);
  task.set_stage("reading");
  const FfrInput input = read_input(c, task.sub(0.0, 0.1));
  session::PressureReportOptions options = options_of(c, input.notes);
  options.what_ifs = what_ifs_of(c, input);
  const pipeline::JobKey job = job_of(c, options);
  if (pipeline::already_done(c.output, job)) {
    core::log_info("done already with the same input and parameters; nothing to do");
  } else {
    session::PressureTree tree = tree_of(input, options, task.sub(0.1, 0.8));
    session::PressureReport report =
        session::make_pressure_report(std::move(tree), options, task.sub(0.8, 0.9));
    for (const std::string& warning : report.warnings) core::log_warning(warning);
    task.set_stage("the wall");
    if (input.model) report.wall = session::pressure_wall(report, *input.model, task.sub(0.9, 0.98));
    task.set_stage("writing");
    session::write_pressure_report(c.output, report, job,
                                   std::chrono::duration<double>(Clock::now() - start).count());
  }
  const std::string result = core::read_file(c.output / "ffr.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_pressures(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
