// The figures of QA mode brought up to date after an edit.

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/session/quality_check.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

namespace ostia {
namespace {

/// Contours every 0.5 mm along 28 mm of each vessel, a little wider than it is.
geometry::ContourSet truth(const lumen::LumenModel& model) {
  geometry::ContourSet set;
  for (const auto& vessel : model.vessels) {
    geometry::ContourSection section;
    section.section = "s" + std::to_string(vessel->vessel);
    section.vessel = model.tree.vessels[set.sections.size()].name;
    section.observer = "truth";
    const double from = vessel->own_from_mm + 4.0, to = std::min(vessel->axis->length() - 2.0, from + 28.0);
    for (double s = from; s <= to; s += 0.5) {
      geometry::Contour contour{s, {}};
      for (int i = 0; i < 64; ++i)
        contour.points.push_back(
            vessel->axis->place(s, 2.0 * std::numbers::pi * i / 64, vessel->axis->radius(s) + 0.2));
      section.contours.push_back(contour);
    }
    set.sections.push_back(section);
  }
  return set;
}

void FiguresAfterAnEdit(benchmark::State& state) {
  const std::string path = "ostia-bench-quality-" + std::to_string(::getpid()) + ".ostia";
  lumen::SamplingOptions sampling;
  sampling.spacing_mm = 0.7;
  const lumen::LumenModel model =
      lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree()), {}, sampling);
  session::Workbench bench;
  bench.set_session(session::Session(session::CaseFile::create(path, model)));
  session::QualityCheck check(bench);
  check.set_truth(truth(model));
  benchmark::DoNotOptimize(check.of_case());
  const double whole_ms = check.last_update_ms();
  const auto whole = static_cast<double>(check.last_update_contours());
  int i = 0;
  double worst = 0.0, contours = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    const lumen::VesselLumen& vessel = *model.vessels[static_cast<std::size_t>(i / 7) % model.vessels.size()];
    const double s = vessel.own_from_mm + 10.0 + i % 7, radius = vessel.axis->radius(s);
    lumen::WallDrag drag;
    drag.vessel = vessel.vessel;
    drag.from = vessel.axis->place(s, 1.0, radius);
    drag.to = vessel.axis->place(s, 1.0, radius + 0.15);
    bench.edit(drag);
    ++i;
    state.ResumeTiming();
    benchmark::DoNotOptimize(check.of_case());
    worst = std::max(worst, check.last_update_ms());
    contours += static_cast<double>(check.last_update_contours());
  }
  state.counters["all_ms"] = whole_ms;
  state.counters["all_contours"] = whole;
  state.counters["worst_ms"] = worst;
  state.counters["contours"] = contours / i;
  std::filesystem::remove(path);
}
BENCHMARK(FiguresAfterAnEdit)->Iterations(30)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ostia
