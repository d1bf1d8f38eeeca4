#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/segmentation/minimal_path.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace ostia::segmentation {
namespace {

/// 512 x 512 x 300 voxels with noise of 25 HU: a parent 110 mm long, a branch 80 mm long that winds, and a
/// chamber full of contrast beside it.
struct Scene {
  imaging::ImageVolume image;
  geometry::VesselTree tree;
  std::vector<Vec3> branch;
};

void put_ball(imaging::ImageVolume& image, const Vec3& centre, double radius, double hu) {
  const imaging::Geometry& g = image.geometry;
  const double reach = radius + 1.2;
  std::array<std::int64_t, 3> low{}, high{};
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    low[n] = std::max<std::int64_t>(0, std::llround((centre[d] - reach) / g.spacing[d]));
    high[n] = std::min<std::int64_t>(g.size[n] - 1, std::llround((centre[d] + reach) / g.spacing[d]));
  }
  for (std::int64_t k = low[2]; k <= high[2]; ++k) {
    for (std::int64_t j = low[1]; j <= high[1]; ++j) {
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        const Vec3 p = g.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        const double part = 0.5 * std::erfc(((p - centre).norm() - radius) / (std::sqrt(2.0) * 0.35));
        image(i, j, k) = std::max(image(i, j, k), static_cast<std::int16_t>(60.0 + (hu - 60.0) * part));
      }
    }
  }
}

const Scene& scene() {
  static const Scene made = [] {
    Scene s;
    s.image.geometry.size = {512, 512, 300};
    s.image.geometry.spacing = Vec3(0.35, 0.35, 0.45);
    s.image.voxels.assign(static_cast<std::size_t>(s.image.geometry.voxels()), 60);
    const std::vector<Vec3> parent = geometry::resample({Vec3(30, 90, 70), Vec3(140, 90, 70)}, 0.4);
    s.branch.emplace_back(60, 90, 70);
    while (geometry::length(s.branch) < 80.0) {
      const double t = geometry::length(s.branch) / 80.0;
      s.branch.push_back(s.branch.back() +
                         0.4 * Vec3(0.8, 0.8 * std::cos(5.0 * t), 0.6 * std::sin(9.0 * t)).normalized());
    }
    for (const Vec3& p : parent) put_ball(s.image, p, 1.8, 380.0);
    for (const Vec3& p : s.branch) put_ball(s.image, p, 1.0, 350.0);
    put_ball(s.image, Vec3(90, 135, 70), 24.0, 370.0);
    std::mt19937 generator(3);
    std::normal_distribution<float> noise(0.0F, 25.0F);
    std::vector<std::int16_t> pool(1 << 16);
    for (std::int16_t& value : pool) value = static_cast<std::int16_t>(std::lround(noise(generator)));
    for (std::int16_t& voxel : s.image.voxels)
      voxel = static_cast<std::int16_t>(voxel + pool[generator() & 0xFFFF]);
    s.tree.nodes = {{1, parent.front()}, {2, parent.back()}};
    geometry::TreeSegment segment{3, 1, 2, {}};
    segment.axis.points = parent;
    segment.axis.radius.assign(parent.size(), 1.8);
    geometry::complete(segment.axis);
    s.tree.segments = {segment};
    s.tree.vessels = {{4, "LAD", {3}}};
    return s;
  }();
  return made;
}

void path_to_tree(benchmark::State& state) {
  const Scene& s = scene();
  MinimalPath path;
  for (auto _ : state) path = segmentation::path_to_tree(s.image, s.branch.back(), s.tree);
  double error = 0.0;
  for (const Vec3& p : path.points) error += (geometry::closest(s.branch, p).point - p).norm();
  state.counters["visited"] = static_cast<double>(path.visited);
  state.counters["error_mm"] = error / static_cast<double>(path.points.size());
}
BENCHMARK(path_to_tree)->Unit(benchmark::kMillisecond)->UseRealTime();

/// A click in the middle of a chamber: nothing to follow, until the front gives up.
void path_from_a_chamber(benchmark::State& state) {
  const Scene& s = scene();
  for (auto _ : state) {
    try {
      benchmark::DoNotOptimize(segmentation::path_to_tree(s.image, Vec3(90, 135, 70), s.tree));
    } catch (const GeometryError&) {
      state.SetLabel("gave up");
    }
  }
}
BENCHMARK(path_from_a_chamber)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ostia::segmentation
