// The options of `ostia experiment` and its subcommands.

#include "experiment/experiment.h"
#include "options/shown_defaults.h"
#include "options/validators.h"

#include "ostia/experiments/simulated_reader.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace ostia::app {

void define_experiment(CLI::App& app, ExperimentCommand& c, const std::uint64_t& seed,
                       std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* experiment =
      app.add_subcommand("experiment", "The papers' experiments: each one table; --json of each");
  experiment->footer("Example:\n  ostia experiment editing --suite suite -o out");
  experiment->fallthrough();
  experiment->require_subcommand(1);
  const experiments::ReaderOptions reader{};
  CLI::App* editing = experiment->add_subcommand(
      "editing", "A simulated reader edits lumen sections until they agree with an observer's contours");
  editing->footer(
      "Example:\n  ostia phantom -o suite --cases 18 --truth-only\n  ostia experiment editing --suite suite "
      "-o out");
  editing->fallthrough();
  editing->add_option("--suite", c.suite, "Folder of a suite, as `ostia phantom --cases 18` makes it")
      ->required();
  editing->add_option("-o,--output", c.output, "Folder that is made")->required();
  editing->add_option("--observer", c.observer,
                      "Whose contours the reader sees: observer1, observer2, ..., truth");
  editing->add_option(
      "--start-excess", c.start_excess_mm,
      "How much wider than the section's mean radius the tube is that editing starts from, mm");
  editing
      ->add_option("--pointing-error", c.pointing_mm,
                   "Standard deviation of a click, mm" + default_text(reader.pointing_sigma_mm))
      ->check(zero_or_above());
  editing->add_option("--points", c.points, "Of a stroke, at most" + default_text(reader.points))
      ->check(CLI::Range(4, 100));
  editing
      ->add_option("--visible", c.visible_px,
                   "Disagreements of more pixels are seen" + default_text(reader.visible_px))
      ->check(above_zero());
  editing->add_flag("--json", c.json, "The figures as JSON on standard output");
  editing->callback([&c, &seed, &run] {
    c.seed = seed;
    run = [&c](const core::TaskContext& task) { return run_experiment_editing(c, task); };
  });
  define_experiment_extraction(*experiment, run);
  define_experiment_orientations(*experiment, seed, run);
  define_experiment_smoothness(*experiment, seed, run);
  define_experiment_chain(*experiment, run);
  define_experiment_carotid(*experiment, seed, run);
  define_experiment_sensitivity(*experiment, seed, run);
  define_experiment_robustness(*experiment, seed, run);
  define_experiment_reading(*experiment, seed, run);
  define_experiment_certainty(*experiment, seed, run);
  define_experiment_hard(*experiment, seed, run);
  define_experiment_motion(*experiment, seed, run);
  define_experiment_pressure(*experiment, seed, run);
  define_experiment_wall_spread(*experiment, seed, run);
}

}  // namespace ostia::app
