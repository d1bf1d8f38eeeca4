// Pressures that follow a hand: from an edit of a wall that is solved to FFR of the whole tree.

#include "vessel_trees.h"

#include "ostia/lumen/live_model.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/model_changes.h"
#include "ostia/session/pressure_readout.h"
#include "ostia/session/pressure_what_if.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <vector>

namespace ostia {
namespace {

/// Five vessels, about 4,000 samples.
std::shared_ptr<const lumen::LumenModel> pulled_tree() {
  lumen::SamplingOptions sampling;
  sampling.spacing_mm = 0.7;
  return std::make_shared<const lumen::LumenModel>(
      lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree()), {}, sampling));
}

analysis::SurfaceOfVessel walls_of(const lumen::LiveModel& live) {
  return [&live](std::int32_t one) { return live.surface(one); };
}

session::PressureReport whole(const lumen::LiveModel& live, const session::PressureReportOptions& options) {
  return session::make_pressure_report(session::pressure_tree(live.model(), walls_of(live)), options);
}

void a_tree_measured_whole(benchmark::State& state) {
  const lumen::LiveModel live(pulled_tree());
  for (auto _ : state) benchmark::DoNotOptimize(whole(live, {}));
}
BENCHMARK(a_tree_measured_whole)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

double process_ms() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double upper(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 95 / 100];
}

/// A pull of the wall in the middle of the first vessel, a step of 0.02 mm at a time; each is solved before,
/// which is not counted here.
void after_a_pull(benchmark::State& state, bool with_what_if) {
  lumen::LiveModel live(pulled_tree());
  const lumen::VesselLumen vessel = *live.model().vessels.front();
  const double s = 0.6 * vessel.axis->length(), radius = vessel.axis->radius(s);
  session::PressureReportOptions options;
  if (with_what_if) options.what_ifs = {{vessel.vessel, s - 8.0, s + 8.0, session::WhatIfKind::open, 0.0}};
  session::PressureReport report = whole(live, options);
  const lumen::LumenModel start = live.model();  // a drag is an edit of the model before it
  std::vector<double> wall, cpu;
  double moved_mm = 0.0;
  int i = 0;
  for (auto _ : state) {
    state.PauseTiming();
    lumen::WallDrag pull;
    pull.vessel = vessel.vessel;
    pull.from = vessel.axis->place(s, 0.0, radius);
    pull.to = vessel.axis->place(s, 0.0, radius - 0.02 * (1 + i++ % 25));
    pull.reach_mm = 3.0;
    lumen::EditOutcome outcome = lumen::apply(start, pull);
    outcome.changes = session::changes_between(live.model(), outcome.model);
    const lumen::LiveChange change = live.follow(outcome);
    std::vector<session::MovedWall> moved;
    for (const auto& one : change.vessels) {
      moved.push_back({one.vessel, std::max(0.0, one.from_mm), one.to_mm});
      moved_mm += one.to_mm - one.from_mm;
    }
    state.ResumeTiming();
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_before = process_ms();
    report = session::after_walls_moved(report, live.model(), walls_of(live), moved);
    cpu.push_back(process_ms() - cpu_before);
    wall.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  state.counters["p95_ms"] = upper(wall);
  state.counters["cpu_p95_ms"] = upper(cpu);
  state.counters["moved_mm"] = moved_mm / static_cast<double>(wall.size());
  state.counters["newton"] = report.hyperaemia.solution.iterations;
}
BENCHMARK_CAPTURE(after_a_pull, of_a_wall, false)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(50)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(after_a_pull, with_a_stretch_opened, true)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(50)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void another_input(benchmark::State& state) {
  const lumen::LiveModel live(pulled_tree());
  const session::PressureReport report = whole(live, {});
  session::PressureReportOptions options;
  options.conditions.systolic_mmhg = 140.0;
  for (auto _ : state) benchmark::DoNotOptimize(session::with_options(report, options));
}
BENCHMARK(another_input)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ostia
