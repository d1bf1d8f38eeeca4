// One synthetic patient scanned twice, 512 x 512 x 300 voxels: turned by 15 degrees, shifted by 20 mm, at
// another phase, with other contrast and noise. The scans are made before the clock runs; `peak_mb` is what
// the registration needs at most, the two scans among it.

#include "phantom_pair.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

namespace {

using namespace ostia;

/// The kernel's own count of the most memory so far; written to, it begins anew.
double peak_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}
void forget_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

const phantom_pair::PhantomPair& full_pair() {
  static const phantom_pair::PhantomPair pair([&] {
    phantom_pair::PairOptions options;
    options.preset = phantom::Preset::full;
    return options;
  }());
  return pair;
}

void tell(benchmark::State& state, const phantom_pair::PhantomPair& pair,
          const registration::Registration& found) {
  state.counters["rigid_axes_mm"] = pair.mean_error_mm(found.rigid, pair.axes());
  state.counters["axes_mm"] = pair.mean_error_mm(found.transform, pair.axes());
  state.counters["heart_mm"] = pair.mean_error_mm(found.transform, pair.heart_points());
  state.counters["least_jacobian"] = found.quality.jacobian_min;
  state.counters["inverse_mm"] = found.quality.inverse_consistency_mm;
  state.counters["correlation"] = found.quality.correlation;
  state.counters["good"] = found.quality.verdict == registration::Verdict::good;
  state.counters["peak_mb"] = peak_mb();
}

void register_pair(benchmark::State& state, bool landmarks) {
  const phantom_pair::PhantomPair& pair = full_pair();
  registration::Guidance guidance{pair.axes(), {}};
  if (landmarks) guidance.landmarks = pair.landmarks();
  forget_peak();
  registration::Registration found;
  for (auto _ : state) found = registration::register_scans(pair.fixed, pair.moving, guidance);
  tell(state, pair, found);
}

void by_trees(benchmark::State& state) {
  register_pair(state, true);
}
void by_the_image_alone(benchmark::State& state) {
  register_pair(state, false);
}
BENCHMARK(by_trees)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()->Iterations(1);
BENCHMARK(by_the_image_alone)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
