#include "ostia/segmentation/vesselness.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace ostia::segmentation {
namespace {

/// 4.7 Mvoxel of 0.4 x 0.4 x 0.5 mm: winding vessels of 0.9 to 2.6 mm radius, a chamber, and noise of 25 HU.
/// The mask has the voxels about them that are as bright as contrast: 5 % of all.
struct Scene {
  imaging::ImageVolume image;
  imaging::MaskVolume mask;
  double masked = 0.0;  // share
};

double inside_of_vessels(const imaging::Vec3& p) {
  double inside = 14.0 - (p - imaging::Vec3(58.0, 20.0, 32.0)).norm();
  for (int n = 0; n < 6; ++n) {
    const double x = 12.0 + 13.0 * n + 4.0 * std::sin(0.1 * p[2] + n);
    const double y = 14.0 + 9.0 * n + 6.0 * std::cos(0.13 * p[2] - n);
    const double radius = 2.6 - 0.3 * n;
    inside = std::max(inside, radius - std::hypot(p[0] - x, p[1] - y));
  }
  for (int n = 0; n < 4; ++n) {
    const double y = 12.0 + 16.0 * n + 5.0 * std::sin(0.08 * p[0] + n);
    const double z = 10.0 + 14.0 * n + 4.0 * std::cos(0.11 * p[0] + n);
    inside = std::max(inside, 1.8 - 0.3 * n - std::hypot(p[1] - y, p[2] - z));
  }
  return inside;
}

const Scene& scene() {
  static const Scene made = [] {
    Scene s;
    s.image.geometry.size = {208, 176, 128};
    s.image.geometry.spacing = imaging::Vec3(0.4, 0.4, 0.5);
    s.mask.geometry = s.image.geometry;
    std::mt19937 generator(3);
    std::normal_distribution<double> noise(0.0, 25.0);
    for (std::int64_t k = 0; k < 128; ++k) {
      for (std::int64_t j = 0; j < 176; ++j) {
        for (std::int64_t i = 0; i < 208; ++i) {
          const double inside = inside_of_vessels(s.image.geometry.world(
              imaging::Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))));
          const double hu =
              60.0 + 320.0 * 0.5 * std::erfc(-inside / (std::sqrt(2.0) * 0.3)) + noise(generator);
          s.image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu)));
          s.mask.voxels.push_back(hu > 180.0 ? 1 : 0);
          s.masked += s.mask.voxels.back();
        }
      }
    }
    s.masked /= static_cast<double>(s.mask.voxels.size());
    return s;
  }();
  return made;
}

void run(benchmark::State& state, TubeMethod method, bool masked, TubeAxes axes) {
  const Scene& s = scene();
  VesselnessOptions options;
  options.method = method;
  options.axes = axes;
  VesselnessPlace place;
  if (masked) place.mask = &s.mask;
  for (auto _ : state)
    benchmark::DoNotOptimize(vesselness(s.image, place, options).response_hu.voxels.data());
  const double mvoxels = 1e-6 * static_cast<double>(s.image.geometry.voxels());
  state.counters["s_per_mvoxel"] = benchmark::Counter(
      mvoxels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  if (masked) state.counters["masked_share"] = s.masked;
}

void vesselness_flux(benchmark::State& state) {
  run(state, TubeMethod::flux, false, TubeAxes::none);
}
void vesselness_hessian(benchmark::State& state) {
  run(state, TubeMethod::hessian, false, TubeAxes::none);
}
void vesselness_flux_with_axes(benchmark::State& state) {
  run(state, TubeMethod::flux, false, TubeAxes::computed);
}
void vesselness_flux_masked(benchmark::State& state) {
  run(state, TubeMethod::flux, true, TubeAxes::computed);
}
void vesselness_hessian_masked(benchmark::State& state) {
  run(state, TubeMethod::hessian, true, TubeAxes::computed);
}
BENCHMARK(vesselness_flux)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(vesselness_hessian)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(vesselness_flux_with_axes)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(vesselness_flux_masked)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(vesselness_hessian_masked)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace ostia::segmentation
