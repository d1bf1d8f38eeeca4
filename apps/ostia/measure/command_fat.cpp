#include "input/case_image.h"
#include "measure/fat.h"
#include "options/validators.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_report.h"
#include "ostia/session/vessel_fat.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

void write_fat(const FatCommand& c, const session::CaseFat& fat, const pipeline::JobKey& job,
               double seconds) {
  core::StagedFolder staged(c.output);
  core::write_file(staged.temporary() / "fat.json", session::fat_json(fat));
  core::write_file(staged.temporary() / "fat.csv", session::fat_csv(fat));
  core::write_file(staged.temporary() / "fat-map.csv", session::fat_map_csv(fat));
  if (const auto picture = session::fat_picture(fat)) picture->write_png(staged.temporary() / "fat.png");
  pipeline::write_manifest(staged.temporary(), {job, ExitCode::ok, seconds, fat.warnings, "{}"});
  staged.commit();
}

void print_fat(const nlohmann::json& result) {
  const auto text = [](const nlohmann::json& value, int decimals) {
    return value.is_null() ? std::string("-") : core::rounded_text(value.get<double>(), decimals);
  };
  for (const auto& one : result["vessels"]) {
    std::printf("%s %s to %s mm: %s HU, with edges %s HU, %s mm3\n", one["name"].get<std::string>().c_str(),
                text(one["from_mm"], 1).c_str(), text(one["to_mm"], 1).c_str(),
                text(one["mean_hu"], 1).c_str(), text(one["all_mean_hu"], 1).c_str(),
                text(one["volume_mm3"], 0).c_str());
    if (!one["all_mean_at_120_kv_hu"].is_null() && result["tube_kv"].get<double>() != 120.0)
      std::printf("  taken at %s kV; at 120 kV about %s HU\n", text(result["tube_kv"], 0).c_str(),
                  text(one["all_mean_at_120_kv_hu"], 1).c_str());
  }
}

}  // namespace

ExitCode run_fat(const FatCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  session::CaseFatOptions options;
  options.tube_kv = c.tube_kv;
  session::validate(options);
  pipeline::require_free_folder(c.output);
  const session::CaseFile file = session::CaseFile::open(c.input, session::OpenMode::read_only);
  const pipeline::Source source = case_image(c.image, file, task.sub(0.0, 0.2));
  if (!options.tube_kv && source.technique) options.tube_kv = source.technique->tube_kv;
  const nlohmann::json parameters{
      {"tube_kv", options.tube_kv ? nlohmann::json(*options.tube_kv) : nlohmann::json(nullptr)}};
  const pipeline::JobKey job{
      "fat", {{"case", session::report_digest(file)}, {"image", source.sha256}}, parameters.dump()};
  if (pipeline::already_done(c.output, job)) {
    core::log_info("done already with the same input and parameters; nothing to do");
  } else {
    const lumen::LumenModel& model = *file.model();
    const analysis::SurfaceOfVessel surfaces = session::solved_surfaces(model, task.sub(0.2, 0.4));
    const session::CaseFat fat =
        session::case_fat(model, surfaces, *source.image, options, task.sub(0.4, 0.95));
    for (const std::string& warning : fat.warnings) core::log_warning(warning);
    write_fat(c, fat, job, std::chrono::duration<double>(Clock::now() - start).count());
  }
  const std::string result = core::read_file(c.output / "fat.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_fat(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

void define_fat(CLI::App& app, FatCommand& c, std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* fat =
      app.add_subcommand("fat", "How bright the fat about RCA, LAD and LCX is: the fat attenuation index");
  fat->footer("Example:\n  ostia fat heart.ostia --image heart.nrrd -o fat");
  fat->fallthrough();
  fat->add_option("CASE", c.input, "Case (.ostia)")->required();
  fat->add_option("--image", c.image, "The CT that the case was made with: DICOM folder or image")
      ->required();
  fat->add_option("-o,--output", c.output, "Folder that is made: fat.json, fat.csv, fat-map.csv, fat.png")
      ->required();
  fat->add_option("--tube-kv", c.tube_kv, "Tube voltage, kV; left out: as the DICOM files say")
      ->check(above_zero());
  fat->add_flag("--json", c.json, "fat.json on standard output");
  fat->callback([&] { run = [&](const core::TaskContext& task) { return run_fat(c, task); }; });
}

}  // namespace ostia::app
