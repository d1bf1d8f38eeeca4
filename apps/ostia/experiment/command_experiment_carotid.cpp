// `ostia experiment carotid`: one lumen scanned as CT and MR, segmented by advection alone, held against
// itself.

#include "experiment/experiment.h"

#include "ostia/core/files.h"
#include "ostia/experiments/carotid_report.h"
#include "ostia/io/surface_file.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct CarotidCommand {
  std::filesystem::path surface, output;
  experiments::CarotidOptions options;
  bool json = false;
};

ExitCode run_experiment_carotid(const CarotidCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  const geometry::TriMesh given = io::read_surface(command.surface).surface.mesh;
  experiments::CarotidResult result;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment carotid",
       {{"surface", core::sha256_file(command.surface)}},
       experiments::parameters_json(command.options)},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        const auto phantom = experiments::carotid_phantom(given, part.sub(0.0, 0.1));
        result = experiments::run_carotid(phantom, command.options, part.sub(0.1, 0.9));
        experiments::write_carotid_report(folder, phantom, result);
        return experiments::carotid_json(result, command.options);
      },
      task);
  if (!command.json && !result.runs.empty()) std::fputs(experiments::carotid_text(result).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_carotid(CLI::App& experiment, const std::uint64_t& seed,
                               std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<CarotidCommand>();
  experiments::CarotidOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "carotid", "A carotid bifurcation scanned in silico as CT and MR and segmented by advection alone");
  sub->footer("Example:\n  ostia experiment carotid --surface carotid.stl -o out");
  sub->fallthrough();
  sub->add_option("--surface", command->surface, "The true lumen, a surface with open ends (STL, VTP, ...)")
      ->required();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--ct-noise", o.ct_noise, "Standard deviation in the CT, HU, of a contrast of 300")
      ->check(CLI::Range(0.0, 500.0));
  sub->add_option("--mr-noise", o.mr_noise, "Standard deviation in the MR series, of a signal of 1,000")
      ->check(CLI::Range(0.0, 500.0));
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_carotid(*command, task); };
  });
}

}  // namespace ostia::app
