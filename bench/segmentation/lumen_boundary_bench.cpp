#include "ostia/core/parallel.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ostia::segmentation {
namespace {

using geometry::Vec3;

Vec3 axis_point(double z) {
  return {25.6 + 8.0 * std::sin(0.06 * z), 25.6 + 8.0 * std::cos(0.06 * z), z};
}

/// 128 x 128 x 250 voxels of 0.4 mm with a winding vessel of some 110 mm, radius 1.5 mm with waves, noise of
/// 25 HU.
const imaging::ImageVolume& vessel_image() {
  static const imaging::ImageVolume image = [] {
    imaging::ImageVolume out;
    out.geometry.size = {128, 128, 250};
    out.geometry.spacing = Vec3::Constant(0.4);
    out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
    std::mt19937 generator(3);
    for (std::int64_t k = 0; k < 250; ++k)
      for (std::int64_t j = 0; j < 128; ++j)
        for (std::int64_t i = 0; i < 128; ++i) {
          const Vec3 p = out.geometry.world(
              Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
          const double radius = 1.5 + 0.3 * std::sin(0.4 * p.z());
          const double d = (p - axis_point(p.z())).norm() - radius;
          double noise = -6.0;  // twelve uniform numbers: nearly normal, the same on every machine
          for (int n = 0; n < 12; ++n) noise += generator() / 4294967296.0;
          const double hu = -60.0 + 430.0 * 0.5 * std::erfc(d / (std::sqrt(2.0) * 0.3)) + 25.0 * noise;
          out(i, j, k) = static_cast<std::int16_t>(std::lround(hu));
        }
    return out;
  }();
  return image;
}

/// Bar: 100 mm of vessel in at most 1 s.
void lumen_boundary_100_mm(benchmark::State& state) {
  geometry::Centerline line;
  for (double z = 5.0; z < 95.0; z += 0.5) line.points.push_back(axis_point(z));
  geometry::complete(line);
  const geometry::AxisCurve axis(line);
  const double length = std::min(100.0, axis.length());
  const imaging::ImageVolume& image = vessel_image();
  core::set_max_threads(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(lumen_boundary(image, axis, 0.0, length));
  core::set_max_threads(0);
  state.counters["mm"] = length;
}
BENCHMARK(lumen_boundary_100_mm)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace ostia::segmentation
