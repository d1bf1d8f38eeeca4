#include "input/input_digest.h"
#include "measure/calcium.h"
#include "options/model_options.h"
#include "options/validators.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/calcium_report.h"
#include "ostia/pipeline/source.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

/// "3:LAD".
std::map<int, analysis::CalciumPlace> places_of(const std::vector<std::string>& texts) {
  std::map<int, analysis::CalciumPlace> places;
  for (const std::string& text : texts) {
    const std::size_t colon = text.find(':');
    int number = 0;
    const char* end = text.data() + std::min(colon, text.size());
    const auto [read, error] = std::from_chars(text.data(), end, number);
    if (colon == std::string::npos || error != std::errc() || read != end || number < 1)
      throw UsageError("--assign is a lesion's number and its place, such as 3:LAD, and not \"" + text +
                       "\"");
    try {
      places[number] = analysis::calcium_place(std::string_view(text).substr(colon + 1));
    } catch (const InvalidInput& wrong) {
      throw UsageError(std::string("--assign: ") + wrong.what());
    }
  }
  return places;
}

analysis::CalciumOptions options_of(const CalciumCommand& c) {
  analysis::CalciumOptions options;
  options.average_thin = c.slices != "as-scanned";
  options.calibration = c.calibration;
  analysis::validate(options);
  return options;
}

pipeline::JobKey job_of(const CalciumCommand& c, const pipeline::Source& source) {
  const nlohmann::json parameters{{"assign", c.assign},
                                  {"calibration", c.calibration ? nlohmann::json(*c.calibration) : nullptr},
                                  {"slices", c.slices}};
  return {"calcium", {{"image", source.sha256}}, parameters.dump()};
}

void print_calcium(const nlohmann::json& result) {
  const auto text = [](const nlohmann::json& value, int decimals) {
    return value.is_null() ? std::string("-") : core::rounded_text(value.get<double>(), decimals);
  };
  for (const auto& [name, amount] : result["vessels"].items())
    std::printf("%-4s Agatston %s, %s mm3\n", name.c_str(), text(amount["agatston"], 1).c_str(),
                text(amount["volume_mm3"], 1).c_str());
  const auto& total = result["total"];
  std::printf("all  Agatston %s (%s), %s mm3, CAC-DRS %s\n", text(total["agatston"], 1).c_str(),
              result["category"].get<std::string>().c_str(), text(total["volume_mm3"], 1).c_str(),
              result["cac_drs"].get<std::string>().c_str());
  for (const auto& lesion : result["lesions"]) {
    if (!lesion["coronary"].get<bool>() && lesion["agatston"].get<double>() < 1.0) continue;
    std::printf("lesion %d: %s%s, Agatston %s, at %s, %s, %s\n", lesion["number"].get<int>(),
                lesion["place"].get<std::string>().c_str(),
                lesion["assigned"].get<bool>() ? " (assigned)" : "", text(lesion["agatston"], 1).c_str(),
                text(lesion["centre"][0], 1).c_str(), text(lesion["centre"][1], 1).c_str(),
                text(lesion["centre"][2], 1).c_str());
  }
  std::printf("places are proposals until a person has looked: --assign NUMBER:PLACE corrects them\n");
}

pipeline::ScoredScan scored(const CalciumCommand& c, const pipeline::Source& source,
                            const std::map<int, analysis::CalciumPlace>& places,
                            const core::TaskContext& task) {
  analysis::CalciumOptions options = options_of(c);
  pipeline::ScoredScan scan;
  scan.pseudonym = source.pseudonym;
  if (source.technique) {
    scan.tube_kv = source.technique->tube_kv;
    options.slice_thickness_mm = source.technique->slice_mm;
  }
  naming(c.input.input, [&] {
    scan.scored = analysis::score_calcium(*source.image, options, task);
    scan.scored.score = analysis::with_places(std::move(scan.scored.score), places);
  });
  if (scan.tube_kv && std::abs(*scan.tube_kv - 120.0) > 0.5)
    scan.scored.score.warnings.push_back("the tube voltage is " + core::rounded_text(*scan.tube_kv, 0) +
                                         " kV, and the threshold of 130 HU is for 120 kV: calcium is "
                                         "brighter at less, and the score too high");
  for (const std::string& warning : scan.scored.score.warnings) core::log_warning(warning);
  return scan;
}

}  // namespace

ExitCode run_calcium(const CalciumCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const std::map<int, analysis::CalciumPlace> places = places_of(c.assign);
  options_of(c);
  pipeline::require_free_folder(c.output);
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load_ct(c.input.input, source_options(c.input), task.sub(0.0, 0.4));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  const pipeline::JobKey job = job_of(c, source);
  if (pipeline::already_done(c.output, job)) {
    core::log_info("done already with the same input and parameters; nothing to do");
  } else {
    const pipeline::ScoredScan scan = scored(c, source, places, task.sub(0.4, 0.9));
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    pipeline::write_calcium_report(c.output, scan, job, seconds, task.sub(0.9, 1.0));
  }
  const std::string result = core::read_file(c.output / "calcium.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_calcium(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

void define_calcium(CLI::App& app, CalciumCommand& c, std::function<ExitCode(const core::TaskContext&)>& run,
                    const std::function<void(CLI::App&, InputOptions&)>& add_dicom) {
  CLI::App* calcium =
      app.add_subcommand("calcium", "The calcium score of a CT without contrast agent, by vessel");
  calcium->footer(
      "Example:\n  ostia calcium scan.nrrd -o calcium\n  ostia calcium scan.nrrd -o corrected --assign 1:LAD "
      "--assign 2:none");
  calcium->fallthrough();
  calcium->add_option("INPUT", c.input.input, "DICOM folder or zip, or image")->required();
  add_dicom(*calcium, c.input);
  calcium
      ->add_option("-o,--output", c.output,
                   "Folder that is made: calcium.json, lesions.csv, lesions.nrrd, slices.png")
      ->required();
  calcium
      ->add_option("--assign", c.assign,
                   "Where a lesion lies, NUMBER:PLACE with LM, LAD, LCX, RCA, aorta, valve, bone or none; "
                   "repeat")
      ->allow_extra_args(false);
  calcium
      ->add_option(
          "--calibration", c.calibration,
          "For the mass: mg/cm3 of hydroxyapatite for each HU, of scanner and protocol; left out: no "
          "mass")
      ->check(above_zero());
  calcium
      ->add_option("--slices", c.slices,
                   "3mm: thin slices are averaged to some 3 mm; as-scanned: scored as they are")
      ->check(CLI::IsMember({"3mm", "as-scanned"}));
  calcium->add_flag("--json", c.json, "calcium.json on standard output");
  calcium->callback([&] { run = [&](const core::TaskContext& task) { return run_calcium(c, task); }; });
}

}  // namespace ostia::app
