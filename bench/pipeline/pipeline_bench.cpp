// The whole way: reading, model, folder with its report.

#include "shared_data.h"

#include "ostia/pipeline/model_folder.h"
#include "ostia/pipeline/report.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

void model_of(benchmark::State& state, const pipeline::Source& source,
              const pipeline::ModelOptions& options) {
  const auto folder = ostia::testing::temporary_folder("bench") / "out";
  const pipeline::Model model = pipeline::build_model(source, options);
  const pipeline::JobKey key{"model", {{"input", model.source.sha256}}, pipeline::parameters_json(options)};
  pipeline::write_model_folder(folder, model, options, key, std::nullopt, 0.0);
  state.counters["tetrahedra"] = static_cast<double>(model.meshed.mesh.tetrahedra.size());
  state.counters["peak_mb"] = pipeline::peak_memory_mb();
}

void whole_model_on_the_aorta_cta(benchmark::State& state) {
  const auto path = ostia::testing::shared_data("cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  if (!path) {
    state.SkipWithError("needs shared data: cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
    return;
  }
  pipeline::ModelOptions options;
  options.segment.bright_is_lumen = true;
  options.branches = {{{4.8, -185.2, 666.2}, std::nullopt, {15.3, -164.2, 742.7}},
                      {{15.3, -164.2, 742.7}, std::nullopt, {22.8, -111.7, 684.2}}};
  for (auto _ : state) model_of(state, pipeline::load(*path), options);
}
BENCHMARK(whole_model_on_the_aorta_cta)
    ->Name("whole ostia model on the aorta CTA")
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

void whole_model_on_the_builtin_case(benchmark::State& state) {
  for (auto _ : state) {
    const phantom::BuiltinCase builtin = phantom::make_builtin_case();
    pipeline::ModelOptions options;
    options.branches = pipeline::branches_of(builtin);
    model_of(state, pipeline::source_of(builtin), options);
  }
}
BENCHMARK(whole_model_on_the_builtin_case)
    ->Name("whole ostia model on the built-in case")
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
