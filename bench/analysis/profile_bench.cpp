// The lumen along a vessel, from end to end and where an edit has changed it.

#include "vessel_trees.h"

#include "ostia/analysis/stenosis.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/vessel_lumen.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace ostia;

/// 150 mm of a vessel, radius 2.0 to 0.9 mm, a little oval, with a stenosis; `off_mm`: how far the axis is
/// off the middle.
struct Vessel {
  lumen::LumenModel model;
  std::shared_ptr<const lumen::ImplicitSurface> wall;
  analysis::SurfaceOfVessel surface_of;

  explicit Vessel(double off_mm) {
    const auto radius = [off_mm](double s, double theta) {
      const double narrowing = 0.6 * std::exp(-std::pow((s - 60.0) / 4.0, 2));
      const double r = (2.0 - 1.1 * s / 150.0) * (1.0 - narrowing), off = off_mm * r;
      const double circle = off * std::cos(theta) + std::sqrt(r * r - std::pow(off * std::sin(theta), 2));
      return circle * (1.0 + 0.05 * std::cos(2.0 * theta));
    };
    model = lumen::model_of_walls(
        lumen::testing::tree_of(geometry::helix_tube(20.0, 40.0, 1.136, 1.5, 0.25).tubes.front()), {radius});
    wall = std::make_shared<const lumen::ImplicitSurface>(lumen::solve(*model.vessels.front()));
    surface_of = [this](std::int32_t) { return wall; };
  }
  Vessel(const Vessel&) = delete;
};

/// The argument: how far the axis is off the middle, in per cent of the radius.
void lumen_profile(benchmark::State& state) {
  const Vessel vessel(static_cast<double>(state.range(0)) / 100.0);
  const std::int32_t id = vessel.model.tree.vessels.front().id;
  core::set_max_threads(2);
  analysis::LumenProfile profile;
  for (auto _ : state) profile = analysis::lumen_profile(vessel.model, vessel.surface_of, id);
  core::set_max_threads(0);
  state.counters["length_mm"] = profile.length_mm;
  state.counters["sections"] = static_cast<double>(profile.sections.size());
  state.counters["samples"] = static_cast<double>(vessel.model.vessels.front()->samples.size());
}
BENCHMARK(lumen_profile)
    ->Arg(0)
    ->Arg(50)
    ->Arg(85)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void update_profile(benchmark::State& state) {
  const Vessel vessel(static_cast<double>(state.range(0)) / 100.0);
  const std::int32_t id = vessel.model.tree.vessels.front().id;
  analysis::LumenProfile profile = analysis::lumen_profile(vessel.model, vessel.surface_of, id);
  core::set_max_threads(2);
  for (auto _ : state) analysis::update_profile(profile, vessel.model, vessel.surface_of, 55.0, 65.0);
  core::set_max_threads(0);
}
BENCHMARK(update_profile)
    ->Arg(0)
    ->Arg(85)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void measured_section(benchmark::State& state) {
  const Vessel vessel(0.0);
  const std::int32_t id = vessel.model.tree.vessels.front().id;
  for (auto _ : state)
    benchmark::DoNotOptimize(analysis::measured_section(vessel.model, vessel.surface_of, id, 40.0));
}
BENCHMARK(measured_section)->Unit(benchmark::kMicrosecond);

void stenoses(benchmark::State& state) {
  const Vessel vessel(0.0);
  const std::int32_t id = vessel.model.tree.vessels.front().id;
  const analysis::LumenProfile profile = analysis::lumen_profile(vessel.model, vessel.surface_of, id);
  std::size_t found = 0;
  for (auto _ : state)
    found = analysis::find_stenoses(profile, analysis::reference_line(profile, {40.0, 90.0})).size();
  state.counters["found"] = static_cast<double>(found);
}
BENCHMARK(stenoses)->Unit(benchmark::kMillisecond);

}  // namespace
