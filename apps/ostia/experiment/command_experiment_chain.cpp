// `ostia experiment chain`: from a scan to a surface of few quadrilaterals, all steps in one.

#include "experiment/experiment.h"
#include "input/input_digest.h"
#include "input/seeds.h"
#include "options/model_options.h"
#include "options/validators.h"

#include "ostia/core/log.h"
#include "ostia/experiments/vessel_chain_report.h"
#include "ostia/pipeline/source.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct ChainCommand {
  InputOptions input;
  std::filesystem::path output;
  std::vector<std::string> seeds, rivals, meshes;
  experiments::ChainOptions options;
  bool circles = false, json = false;
};

/// "SIDES:SPACING:LEVEL".
experiments::ChainMesh parse_mesh(const std::string& text) {
  experiments::ChainMesh mesh;
  int used = 0;
  const int read = std::sscanf(text.c_str(), "%d:%lf:%d%n", &mesh.sides, &mesh.spacing, &mesh.level, &used);
  if (read != 3 || static_cast<std::size_t>(used) != text.size())
    throw UsageError("--mesh " + text + ": give sides, spacing and level, as 4:2.4:0");
  return mesh;
}

ExitCode run_experiment_chain(const ChainCommand& command, const core::TaskContext& task) {
  experiments::ChainOptions options = command.options;
  options.elliptic = !command.circles;
  if (!command.meshes.empty()) options.meshes.clear();
  for (const std::string& text : command.meshes) options.meshes.push_back(parse_mesh(text));
  experiments::validate(options);
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load_ct(command.input.input, source_options(command.input), task.sub(0.0, 0.05));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  const auto places = [&](const std::vector<std::string>& texts) {
    std::vector<geometry::Vec3> out;
    for (const std::string& text : texts) {
      const auto some = seed_points(text, {command.input.coords, &source.image->geometry});
      out.insert(out.end(), some.begin(), some.end());
    }
    return out;
  };
  const std::vector<geometry::Vec3> seeds = places(command.seeds), rivals = places(command.rivals);
  experiments::ChainResult result;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment chain",
       {{"image", digest_of(command.input.input)}},
       experiments::parameters_json(options, seeds, rivals)},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        result = experiments::run_vessel_chain(*source.image, seeds, rivals, options, part.sub(0.0, 0.95));
        experiments::write_chain_report(folder, result, part.sub(0.95, 1.0));
        return experiments::chain_json(result, options, seeds, rivals);
      },
      task.sub(0.05, 1.0));
  if (!command.json && !result.surfaces.empty()) std::fputs(experiments::chain_text(result).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_chain(CLI::App& experiment, std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<ChainCommand>();
  experiments::ChainOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "chain", "From a scan to a surface of few quadrilaterals: all steps, and how far it is off");
  sub->footer(
      "Example:\n  ostia experiment chain CT/ -o out --coords ijk --seed 366,276,88 --rival 352,253,88");
  sub->fallthrough();
  sub->add_option("INPUT", command->input.input, "DICOM folder or zip, or image")->required();
  sub->add_option("--series", command->input.series,
                  "UID of the DICOM series, where the folder holds several");
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--seed", command->seeds, "A place in a vessel that is wanted, x,y,z; repeat")
      ->required()
      ->allow_extra_args(false);
  sub->add_option("--rival", command->rivals, "A place in one that touches it and is not, x,y,z; repeat")
      ->allow_extra_args(false);
  sub->add_option("--coords", command->input.coords,
                  "Frame of the points given: lps or ras (mm), ijk (voxels)")
      ->check(CLI::IsMember({"lps", "ras", "ijk"}));
  sub->add_option("--least", o.growth.least_hu, "Vessels are brighter, HU")
      ->check(CLI::Range(-1000.0, 3000.0));
  sub->add_option("--thinnest", o.thinnest_mm, "Vessels of a smaller diameter are ignored, mm")
      ->check(zero_or_above());
  sub->add_option("--prune", o.prune_mm, "Leaves of the skeleton shorter than this go, mm")
      ->check(zero_or_above());
  sub->add_option("--knots", o.knots_mm, "Distance between the knots of the smooth lines, mm")
      ->check(above_zero());
  sub->add_option("--mesh", command->meshes,
                  "A surface to be made, SIDES:SPACING:LEVEL as `ostia reconstruct` has them; repeat")
      ->allow_extra_args(false);
  sub->add_flag("--circles", command->circles,
                "Sections are circles with the isosurface's areas, no ellipses");
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &run] {
    run = [command](const core::TaskContext& task) { return run_experiment_chain(*command, task); };
  });
}

}  // namespace ostia::app
