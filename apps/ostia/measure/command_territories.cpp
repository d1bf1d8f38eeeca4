#include "input/input_digest.h"
#include "input/mask_input.h"
#include "measure/territories.h"
#include "output/refusal.h"

#include "ostia/analysis/myocardial_territories.h"
#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_tree.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

/// What lies behind a place is asked of.
struct AskedPlace {
  std::string name;
  std::int32_t vessel = 0;
  double s_mm = 0.0;
};

struct TerritoryInput {
  geometry::VesselTree tree;
  std::vector<AskedPlace> lesions;
};

bool has_radii(const geometry::VesselTree& tree) {
  for (const geometry::TreeSegment& segment : tree.segments)
    if (segment.axis.radius.size() != segment.axis.size()) return false;
  return true;
}

TerritoryInput read_input_tree(const std::filesystem::path& path, const core::TaskContext& task) {
  TerritoryInput input;
  std::optional<session::PressureTree> measured;
  if (path.extension() == ".ostia") {
    const auto model = session::CaseFile::open(path, session::OpenMode::read_only).model();
    input.tree = model->tree;
    measured = session::pressure_tree(*model, session::solved_surfaces(*model, task.sub(0.0, 0.6)), {},
                                      task.sub(0.6, 1.0));
  } else {
    input.tree = io::read_centerlines(path);
    if (has_radii(input.tree))
      measured = session::pressure_tree(input.tree, {}, task);
    else
      core::log_warning("the lines have no radii: no lesions are looked for, and the lumen has no volume");
  }
  if (measured)
    for (const hemodynamics::LesionPlace& lesion : measured->lesions)
      input.lesions.push_back(
          {lesion.name, measured->network.branches[lesion.throat.branch].vessel, lesion.throat.s_mm});
  return input;
}

/// "LAD:24".
AskedPlace asked_place(const std::string& text, const geometry::VesselTree& tree) {
  const std::size_t colon = text.rfind(':');
  AskedPlace place{text, 0, 0.0};
  try {
    std::size_t read = 0;
    if (colon == std::string::npos) throw std::invalid_argument(text);
    place.s_mm = std::stod(text.substr(colon + 1), &read);
    if (colon + 1 + read != text.size()) throw std::invalid_argument(text);
  } catch (const std::exception&) {
    throw UsageError("--behind is a vessel and a place along it in mm, such as LAD:24, and not \"" + text +
                     "\"");
  }
  const std::string name = text.substr(0, colon);
  for (const geometry::Vessel& vessel : tree.vessels)
    if (vessel.name == name) {
      place.vessel = vessel.id;
      return place;
    }
  throw InvalidInput("--behind " + text + ": no vessel is named " + name);
}

Json territories_json(const analysis::MyocardialTerritories& found, const TerritoryInput& input,
                      const std::vector<AskedPlace>& asked) {
  Json out{{"v", 1},
           {"kind", "territories"},
           {"mass_g", found.mass_g},
           {"density_g_ml", found.options.density_g_ml},
           {"lumen_mm3", found.lumen_mm3},
           {"lumen_mm3_per_g", found.lumen_mm3_per_g()}};
  out["vessels"] = Json::array();
  for (const analysis::VesselTerritory& one : found.vessels)
    out["vessels"].push_back(
        {{"id", one.vessel}, {"name", one.name}, {"mass_g", one.mass_g}, {"share", one.share}});
  const auto behind = [&](const std::vector<AskedPlace>& places) {
    Json all = Json::array();
    for (const AskedPlace& place : places) {
      const double mass_g = analysis::mass_behind_g(found, input.tree, place.vessel, place.s_mm);
      std::string vessel;
      for (const geometry::Vessel& one : input.tree.vessels)
        if (one.id == place.vessel) vessel = one.name;
      all.push_back({{"name", place.name},
                     {"vessel_name", vessel},
                     {"s_mm", place.s_mm},
                     {"mass_g", mass_g},
                     {"share", mass_g / found.mass_g}});
    }
    return all;
  };
  out["lesions"] = behind(input.lesions);
  out["places"] = behind(asked);
  return out;
}

std::string territories_csv(const Json& result) {
  std::string out = core::csv_line({"what", "name", "s_mm", "mass_g", "share"});
  for (const auto& one : result["vessels"])
    out += core::csv_line({"vessel", one["name"].get<std::string>(), "",
                           core::significant_text(one["mass_g"].get<double>(), 6),
                           core::significant_text(one["share"].get<double>(), 6)});
  for (const char* kind : {"lesions", "places"})
    for (const auto& one : result[kind])
      out += core::csv_line({std::string("behind ") + one["name"].get<std::string>(),
                             one["vessel_name"].get<std::string>(),
                             core::significant_text(one["s_mm"].get<double>(), 6),
                             core::significant_text(one["mass_g"].get<double>(), 6),
                             core::significant_text(one["share"].get<double>(), 6)});
  return out;
}

void print_territories(const Json& result) {
  const auto text = [](const Json& value, int decimals) {
    return core::rounded_text(value.get<double>(), decimals);
  };
  std::printf("myocardium %s g; lumen %s mm3, %s mm3 for each g\n", text(result["mass_g"], 1).c_str(),
              text(result["lumen_mm3"], 0).c_str(), text(result["lumen_mm3_per_g"], 1).c_str());
  for (const auto& one : result["vessels"])
    std::printf("%-6s %s g, %s %%\n", one["name"].get<std::string>().c_str(), text(one["mass_g"], 1).c_str(),
                core::rounded_text(100.0 * one["share"].get<double>(), 1).c_str());
  for (const char* kind : {"lesions", "places"})
    for (const auto& one : result[kind])
      std::printf("behind %s (%s at %s mm): %s g, %s %%\n", one["name"].get<std::string>().c_str(),
                  one["vessel_name"].get<std::string>().c_str(), text(one["s_mm"], 1).c_str(),
                  text(one["mass_g"], 1).c_str(),
                  core::rounded_text(100.0 * one["share"].get<double>(), 1).c_str());
}

}  // namespace

ExitCode run_territories(const TerritoriesCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  pipeline::require_free_folder(c.output);
  for (const std::filesystem::path& file : {c.input, c.myocardium})
    if (!std::filesystem::is_regular_file(file))
      throw IoError("cannot read " + file.string() + ": there is no such file");
  const nlohmann::json parameters{{"label", c.label}, {"behind", c.behind}};
  const pipeline::JobKey job{"territories",
                             {{"input", core::sha256_file(c.input)}, {"myocardium", digest_of(c.myocardium)}},
                             parameters.dump()};
  if (pipeline::already_done(c.output, job)) {
    core::log_info("done already with the same input and parameters; nothing to do");
  } else {
    task.set_stage("reading");
    const TerritoryInput input = read_input_tree(c.input, task.sub(0.0, 0.6));
    std::vector<AskedPlace> asked;
    for (const std::string& text : c.behind) asked.push_back(asked_place(text, input.tree));
    const imaging::MaskVolume muscle = read_asked_labels(
        {c.myocardium, {}, c.label == 0 ? std::vector<int>{} : std::vector{c.label}}, task.sub(0.6, 0.7));
    const auto found = naming(c.myocardium, [&] {
      return analysis::myocardial_territories(input.tree, muscle, {}, task.sub(0.7, 0.9));
    });
    const Json result = territories_json(found, input, asked);
    core::StagedFolder staged(c.output);
    core::write_file(staged.temporary() / "territories.json", result.dump(1) + "\n");
    core::write_file(staged.temporary() / "territories.csv", territories_csv(result));
    imaging::write_image(staged.temporary() / "territories.nrrd", found.labels);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    pipeline::write_manifest(staged.temporary(), {job, ExitCode::ok, seconds, {}, "{}"});
    task.throw_if_cancelled();
    staged.commit();
  }
  const std::string result = core::read_file(c.output / "territories.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_territories(Json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

void define_territories(CLI::App& app, TerritoriesCommand& c,
                        std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* territories = app.add_subcommand(
      "territories", "The left ventricle's muscle by artery, and how much of it lies behind each lesion");
  territories->footer(
      "Example:\n  ostia territories heart.ostia --myocardium labels.nrrd --label 1 -o territories");
  territories->fallthrough();
  territories->add_option("INPUT", c.input, "Case (.ostia) or centerlines (.vtp, .csv, ...)")->required();
  territories
      ->add_option("--myocardium", c.myocardium, "Mask of the left ventricle's muscle (.nrrd, .nii.gz, ...)")
      ->required();
  territories->add_option("--label", c.label, "The mask's value that is muscle; left out: all but 0")
      ->check(CLI::PositiveNumber);
  territories
      ->add_option("-o,--output", c.output,
                   "Folder that is made: territories.json, territories.csv, territories.nrrd")
      ->required();
  territories
      ->add_option("--behind", c.behind,
                   "Also what lies behind a place, VESSEL:MM, mm along the vessel from its root; repeat")
      ->allow_extra_args(false);
  territories->add_flag("--json", c.json, "territories.json on standard output");
  territories->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_territories(c, task); }; });
}

}  // namespace ostia::app
