#include "ostia/segmentation/segment.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

namespace ostia::segmentation {
namespace {

/// 256 x 256 x 252 voxels of 0.4 mm (16.5 million) with a curved vessel 100 mm long, radius 1.75 mm, and
/// noise of 25 HU.
const imaging::ImageVolume& large_image() {
  static const imaging::ImageVolume image = [] {
    imaging::ImageVolume out;
    out.geometry.size = {256, 256, 252};
    out.geometry.spacing = Vec3::Constant(0.4);
    out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
    std::mt19937 generator(3);
    std::normal_distribution<float> noise(0.0F, 25.0F);
    std::vector<float> pool(1 << 16);
    for (float& value : pool) value = noise(generator);
    for (std::int64_t k = 0; k < 252; ++k) {
      for (std::int64_t j = 0; j < 256; ++j) {
        for (std::int64_t i = 0; i < 256; ++i) {
          const Vec3 p = out.geometry.world(
              Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
          const double phase = p.z() * 0.06;
          const double d =
              std::hypot(p.x() - 50.0 - 8.0 * std::sin(phase), p.y() - 50.0 - 8.0 * std::cos(phase)) - 1.75;
          const double lumen = 0.5 * std::erfc(d / (std::sqrt(2.0) * 0.35));
          out(i, j, k) = static_cast<std::int16_t>(50.0 + 300.0 * lumen + pool[generator() & 0xFFFF]);
        }
      }
    }
    return out;
  }();
  return image;
}

Vec3 axis_point(double z) {
  return {50.0 + 8.0 * std::sin(0.06 * z), 50.0 + 8.0 * std::cos(0.06 * z), z};
}
BranchSeeds branch() {
  return {axis_point(6.0), std::nullopt, axis_point(96.2)};
}  // 100 mm along the curve

/// A line of /proc/self/status, MiB.
double status_mib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(key, 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  }
  return 0.0;
}

void colliding_fronts_feature_level_set_100mm_16_5_mvoxel(benchmark::State& state) {
  const imaging::ImageVolume& image = large_image();
  const double before = status_mib("VmRSS");
  for (auto _ : state) {
    const SegmentationResult result = segment_vessels(image, {branch()});
    benchmark::DoNotOptimize(result.level_set.voxels.data());
    state.counters["iterations_of_level_set"] = result.iterations;
  }
  state.counters["peak_mib_on_top_of_image"] = status_mib("VmHWM") - before;
}
BENCHMARK(colliding_fronts_feature_level_set_100mm_16_5_mvoxel)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void colliding_fronts_100mm_16_5_mvoxel(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(colliding_fronts(large_image(), branch()).voxels);
}
BENCHMARK(colliding_fronts_100mm_16_5_mvoxel)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void surface_of_100mm_vessel(benchmark::State& state) {
  const SegmentationResult result = segment_vessels(large_image(), {branch()});
  for (auto _ : state)
    benchmark::DoNotOptimize(surface_of(result.level_set, {branch().from}).triangles.size());
}
BENCHMARK(surface_of_100mm_vessel)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace ostia::segmentation

BENCHMARK_MAIN();
