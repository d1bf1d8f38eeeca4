// `ostia experiment wall-spread`: how often the true calibre lies within the interval that an image lets
// expect.

#include "experiment/experiment.h"

#include "ostia/experiments/wall_spread.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct WallSpreadCommand {
  std::filesystem::path output;
  int fitting = 500, judged = 100;
  std::uint64_t seed = 1;
  bool json = false;
};

ExitCode run_experiment_wall_spread(const WallSpreadCommand& command, const core::TaskContext& task) {
  constexpr std::uint64_t apart = 20000;  // no vessel is in both sets
  experiments::WallSpreadOptions fitting, judged;
  fitting.first_seed = command.seed;
  fitting.vessels = command.fitting;
  fitting.sections = 4;
  judged.first_seed = command.seed + apart;
  judged.vessels = command.judged;
  experiments::validate(fitting);
  experiments::validate(judged);
  std::string text;
  const ExitCode code = run_experiment(
      command.output, {"experiment wall-spread", {}, experiments::parameters_json(fitting, judged)},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        const double share = static_cast<double>(command.fitting) / (command.fitting + command.judged);
        const auto chosen_on = experiments::run_wall_spread(fitting, part.sub(0.0, share));
        const auto of_others = experiments::run_wall_spread(judged, part.sub(share, 1.0));
        experiments::write_wall_spread_report(folder, chosen_on, of_others);
        text = experiments::wall_spread_text(chosen_on, of_others, judged);
        return experiments::wall_spread_json(chosen_on, of_others, judged);
      },
      task);
  if (!command.json) std::fputs(text.c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_wall_spread(CLI::App& experiment, const std::uint64_t& seed,
                                   std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<WallSpreadCommand>();
  CLI::App* sub = experiment.add_subcommand(
      "wall-spread",
      "How often the true calibre lies within the 95 % interval that noise and edges let expect");
  sub->footer("Example:\n  ostia experiment wall-spread -o out");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--fitting", command->fitting, "Vessels on which the spread's scale is chosen")
      ->check(CLI::Range(1, 2000));
  sub->add_option("--judged", command->judged, "Other vessels, of which it is judged; two sections of each")
      ->check(CLI::Range(1, 2000));
  sub->add_flag("--json", command->json, "The table as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_wall_spread(*command, task); };
  });
}

}  // namespace ostia::app
