// The wall of a whole coronary tree: made anew, and brought up to date after an edit of 12 samples.

#include "vessel_trees.h"

#include "ostia/core/parallel.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <random>
#include <utility>

namespace {

using namespace ostia;
using lumen::Vec3;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double p95(std::vector<double> of) {
  std::sort(of.begin(), of.end());
  return of[(of.size() - 1) * 95 / 100];
}

/// Three coronary-like trees side by side: 590 mm of vessel, radius 2.0 to 0.8 mm, 12 vessels.
struct Tree {
  std::vector<lumen::IncrementalSurface> vessels;
  double length_mm = 0.0;
  std::mt19937 random{5};
  std::int64_t next_id = 1000000;

  Tree() {
    for (int copy = 0; copy < 3; ++copy) {
      geometry::AnalyticShape shape = geometry::coronary_like_tree();
      for (auto& tube : shape.tubes)
        for (Vec3& p : tube.axis.points) p += 60.0 * copy * Vec3::UnitY();
      const lumen::LumenModel model = lumen::model_of_tubes(lumen::testing::tree_of(shape));
      for (const auto& vessel : model.vessels) {
        vessels.emplace_back(*vessel);
        length_mm += vessel->axis->length() - vessel->own_from_mm;
      }
    }
  }

  std::shared_ptr<const lumen::TreeField> field() const {
    std::vector<std::shared_ptr<const lumen::ImplicitSurface>> branches;
    for (const auto& vessel : vessels) branches.push_back(vessel.surface());
    return std::make_shared<const lumen::TreeField>(branches, lumen::BlendOptions{});
  }
  std::vector<Vec3> seeds() const {
    std::vector<Vec3> places;
    for (const auto& vessel : vessels)
      for (const auto& sample : vessel.samples()) places.push_back(sample.position);
    return places;
  }

  // Twelve samples that are neighbours move out or in by up to a fifth of a millimetre. Returns the box
  // outside which nothing has changed by 1e-6 mm; `centre` is set to the middle of the edit.
  lumen::Box3 edit(Vec3& centre) {
    auto& vessel = vessels[random() % vessels.size()];
    auto samples = vessel.samples();
    centre = samples[random() % samples.size()].position;
    std::partial_sort(samples.begin(), samples.begin() + 12, samples.end(),
                      [&](const lumen::SurfaceSample& a, const lumen::SurfaceSample& b) {
                        return (a.position - centre).squaredNorm() < (b.position - centre).squaredNorm();
                      });
    samples.resize(12);
    const double step = 0.2 * (static_cast<double>(random()) / 2147483648.0 - 1.0);
    std::vector<std::int64_t> removed;
    for (auto& sample : samples) {
      removed.push_back(sample.id);
      sample.id = next_id++;
      sample.position += step * sample.normal;
      sample.origin = lumen::SampleOrigin::edit;
    }
    return vessel.change(removed, samples).changed;
  }
};

void tree_surface_anew(benchmark::State& state) {
  core::set_max_threads(2);
  const Tree tree;
  const auto field = tree.field();
  const auto seeds = tree.seeds();
  lumen::TreeSurfaceReport report;
  for (auto _ : state) {
    lumen::TreeSurface surface;
    report = surface.build(field, seeds);
    benchmark::DoNotOptimize(surface.mesh());
  }
  state.counters["vessel_mm"] = tree.length_mm;
  state.counters["samples"] = static_cast<double>(seeds.size());
  state.counters["blocks"] = static_cast<double>(report.blocks);
  state.counters["triangles"] = static_cast<double>(report.triangles);
  state.counters["evaluations"] = static_cast<double>(report.evaluations);
  core::set_max_threads(0);
}

/// With `reach_mm` the box is cut to so much on each side of the edit, and what is left out is told: the
/// largest change of f at a sample beyond.
void after_edit(benchmark::State& state, double reach_mm, double keep_within_mm) {
  core::set_max_threads(2);
  Tree tree;
  lumen::TreeSurface surface({.keep_within_mm = keep_within_mm});
  auto field = tree.field();
  surface.build(field, tree.seeds());
  std::vector<double> update_ms, mesh_ms, both_ms, cpu_ms, evaluations, blocks, widest_mm;
  double left_out_mm = 0.0;
  for (auto _ : state) {
    Vec3 centre;
    lumen::Box3 changed = tree.edit(centre);
    const auto before = std::exchange(field, tree.field());
    const auto seeds = tree.seeds();
    if (reach_mm > 0.0) {
      const lumen::Box3 near(centre - Vec3::Constant(reach_mm), centre + Vec3::Constant(reach_mm));
      for (const Vec3& p : seeds)
        if (changed.contains(p) && !near.contains(p))
          left_out_mm = std::max(left_out_mm, 0.5 * std::abs(field->value(p) - before->value(p)));
      changed = changed.intersection(near);
    }
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    const lumen::TreeSurfaceReport report = surface.update(field, changed, seeds);
    update_ms.push_back(milliseconds_since(start));
    const auto joining = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(surface.mesh());
    mesh_ms.push_back(milliseconds_since(joining));
    both_ms.push_back(milliseconds_since(start));
    cpu_ms.push_back(1000.0 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC);
    state.SetIterationTime(both_ms.back() / 1000.0);
    evaluations.push_back(static_cast<double>(report.evaluations));
    blocks.push_back(static_cast<double>(report.blocks_made));
    widest_mm.push_back(changed.sizes().maxCoeff());
  }
  state.counters["update_p95_ms"] = p95(update_ms);
  state.counters["mesh_p95_ms"] = p95(mesh_ms);
  state.counters["both_p95_ms"] = p95(both_ms);
  state.counters["cpu_p95_ms"] = p95(cpu_ms);
  state.counters["evaluations_p95"] = p95(evaluations);
  state.counters["blocks_p95"] = p95(blocks);
  state.counters["changed_mm_p95"] = p95(widest_mm);
  state.counters["left_out_um"] = 1000.0 * left_out_mm;
  core::set_max_threads(0);
}

void tree_surface_after_edit(benchmark::State& state) {
  after_edit(state, 0.0, lumen::unseen_mm);
}
void tree_surface_after_edit_exact(benchmark::State& state) {
  after_edit(state, 0.0, 0.0);
}
void tree_surface_within_15_mm_of_edit(benchmark::State& state) {
  after_edit(state, 7.5, 0.0);
}

BENCHMARK(tree_surface_anew)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(tree_surface_within_15_mm_of_edit)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(100);
BENCHMARK(tree_surface_after_edit)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(100);
BENCHMARK(tree_surface_after_edit_exact)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(100);

}  // namespace
