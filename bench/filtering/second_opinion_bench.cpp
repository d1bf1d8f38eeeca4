// Algorithms of ours and ITK's filters on the same surroundings of a vessel, one after the other: 96 x 96 x
// 128 voxels of 0.4 mm about a tube of 2 mm radius, 20 mm of which are seen, with noise. On one thread unless
// OSTIA_BENCH_THREADS says another number: what is compared is the work. A pair of names is a pair of lines.

#include "fronts/fast_marching.h"
#include "itk_peers.h"
#include "tube_scene.h"

#include "ostia/core/parallel.h"
#include "ostia/filtering/filter.h"
#include "ostia/imaging/diffusion.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/vesselness.h"

#include <benchmark/benchmark.h>

#include <cstdlib>

namespace ostia::filtering::peers {
namespace {

using segmentation::detail::FrontStop;
using segmentation::detail::SpeedModel;
using segmentation::detail::Voxel;

const TubeScene& scene() {
  static const TubeScene one({96, 96, 128}, 2.0, 25.0);
  return one;
}

void diffusion_of_ours(benchmark::State& state) {
  imaging::DiffusionOptions options;
  options.method = state.range(0) == 0 ? imaging::Diffusion::gradient : imaging::Diffusion::curvature;
  options.contrast_hu_per_mm = 150.0;
  options.step = 0.5;
  for (auto _ : state) benchmark::DoNotOptimize(imaging::diffused(scene().floats, options).voxels.data());
}
void diffusion_of_itk(benchmark::State& state) {
  const bool curvature = state.range(0) == 1;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        itk_diffused(scene().floats, curvature, 5, 0.16 / 6.0 * (curvature ? 0.25 : 0.5), 150.0)
            .voxels.data());
}

void vesselness_of_ours(benchmark::State& state) {
  segmentation::VesselnessOptions options;
  options.method = state.range(0) == 0 ? segmentation::TubeMethod::hessian : segmentation::TubeMethod::flux;
  for (auto _ : state)
    benchmark::DoNotOptimize(segmentation::vesselness(scene().image, {}, options).response_hu.voxels.data());
}
void vesselness_of_itk(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(itk_vesselness(scene().floats, 0.53, 2.12, 5).voxels.data());
}

const SpeedModel bench_speed{{150.0, 500.0}, 350.0, 0.5};

struct Ends {
  Vec3 source;
  Voxel seed, target;
};
Ends ends() {
  const auto& grid = scene().image.geometry;
  const Voxel seed = segmentation::detail::nearest_voxel(grid, scene().tube.from);
  return {grid.world(Vec3(seed[0], seed[1], seed[2])), seed,
          segmentation::detail::nearest_voxel(grid, scene().tube.to)};
}

void marching_of_ours(benchmark::State& state) {
  const Ends at = ends();
  FrontStop stop;
  stop.targets = {at.target};
  stop.overrun = 0.0;
  for (auto _ : state) {
    const auto front =
        segmentation::detail::march(scene().image, {at.source}, bench_speed, stop, core::no_task());
    state.counters["arrival"] = front.target_time;
    state.counters["voxels"] = static_cast<double>(front.order.size());
  }
}
/// With the speed image that it needs, and a stop at the arrival of ours, which it cannot know.
void marching_of_itk(benchmark::State& state) {
  const Ends at = ends();
  FrontStop stop;
  stop.targets = {at.target};
  const double arrival =
      segmentation::detail::march(scene().image, {at.source}, bench_speed, stop, core::no_task()).target_time;
  for (auto _ : state) {
    FloatVolume speeds{scene().image.geometry, {}};
    speeds.voxels.reserve(scene().image.voxels.size());
    for (const std::int16_t hu : scene().image.voxels)
      speeds.voxels.push_back(std::max(bench_speed(hu), 1e-4F));
    const FloatVolume times =
        itk_marched(speeds, {{at.seed[0], at.seed[1], at.seed[2]}}, {0.0}, 1.1 * arrival);
    state.counters["arrival"] = times(at.target[0], at.target[1], at.target[2]);
  }
}

void level_set_of_ours(benchmark::State& state) {
  const FloatVolume edges = scene().edges(100.0), start = scene().about_axis(1.2), feature = negated(edges);
  segmentation::LevelSetOptions options;
  options.inflation = 0.1;
  options.curvature = 0.0;
  for (auto _ : state) {
    const auto result = segmentation::level_set(start, feature, edges, options);
    state.counters["iterations"] = result.iterations;
  }
}
/// Until a step changes the surface by 0.002 (root mean square), 300 steps at most.
void level_set_of_itk(benchmark::State& state) {
  const FloatVolume edges = scene().edges(100.0), start = scene().about_axis(1.2);
  int iterations = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(itk_geodesic(start, edges, 0.1, 1.0, 300, 0.002, iterations).voxels.data());
  state.counters["iterations"] = iterations;
}

void blur_by_step(benchmark::State& state) {
  const std::vector<FilterStep> steps{step_of_text("gaussian:sigma_mm=0.8")};
  for (auto _ : state) benchmark::DoNotOptimize(filtered(scene().floats, steps).image.voxels.data());
}

BENCHMARK(diffusion_of_ours)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(diffusion_of_itk)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(vesselness_of_ours)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(vesselness_of_itk)->Unit(benchmark::kMillisecond);
BENCHMARK(marching_of_ours)->Unit(benchmark::kMillisecond);
BENCHMARK(marching_of_itk)->Unit(benchmark::kMillisecond);
BENCHMARK(level_set_of_ours)->Unit(benchmark::kMillisecond);
BENCHMARK(level_set_of_itk)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(blur_by_step)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ostia::filtering::peers

int main(int argc, char** argv) {
  const char* threads = std::getenv("OSTIA_BENCH_THREADS");
  ostia::core::set_max_threads(threads != nullptr ? std::atoi(threads) : 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
