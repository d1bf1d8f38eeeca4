// The skeleton of a tree in 256 x 256 x 256 voxels.

#include "skeleton_bench.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/centerline/skeleton_radius.h"
#include "ostia/core/parallel.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace ostia;
using centerline::Vec3;

constexpr std::int64_t side = 256;
constexpr double voxel_mm = 0.4;

void draw(imaging::MaskVolume& mask, const Vec3& a, const Vec3& b, double radius) {
  const Vec3 low = (a.cwiseMin(b) - Vec3::Constant(radius)) / voxel_mm;
  const Vec3 high = (a.cwiseMax(b) + Vec3::Constant(radius)) / voxel_mm;
  const auto from = [&](int d) { return std::max<std::int64_t>(0, static_cast<std::int64_t>(low[d])); };
  const auto to = [&](int d) {
    return std::min<std::int64_t>(side - 1, static_cast<std::int64_t>(high[d]) + 1);
  };
  for (std::int64_t k = from(2); k <= to(2); ++k)
    for (std::int64_t j = from(1); j <= to(1); ++j)
      for (std::int64_t i = from(0); i <= to(0); ++i) {
        const Vec3 p =
            voxel_mm * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        if ((p - a - t * (b - a)).norm() <= radius) mask(i, j, k) = 1;
      }
}

void grow(imaging::MaskVolume& mask, const Vec3& from, const Vec3& direction, double radius, int generation) {
  const Vec3 to = from + (14.0 * std::pow(0.87, generation)) * direction;
  draw(mask, from, to, radius);
  if (generation == 7) return;
  const Vec3 across = Eigen::AngleAxisd(1.3 * generation, direction) * direction.unitOrthogonal();
  for (const double sign : {-1.0, 1.0})
    grow(mask, to, (direction + 0.55 * sign * across).normalized(), 0.82 * radius, generation + 1);
}

const imaging::MaskVolume& tree_mask() {
  static const imaging::MaskVolume mask = [] {
    imaging::MaskVolume m;
    m.geometry.size = {side, side, side};
    m.geometry.spacing = Vec3::Constant(voxel_mm);
    m.voxels.assign(static_cast<std::size_t>(m.geometry.voxels()), 0);
    grow(m, Vec3(51.0, 51.0, 8.0), Vec3::UnitZ(), 3.5, 0);
    return m;
  }();
  return mask;
}

void skeleton_256(benchmark::State& state) {
  core::set_max_threads(2);
  const imaging::MaskVolume& mask = tree_mask();
  centerline::SkeletonGraph graph;
  std::int64_t object = 0;
  for (auto _ : state) {
    const centerline::Thinned thin = centerline::thinned(mask, {.fill_cavities = true});
    object = thin.object_voxels;
    graph = centerline::gaps_closed(
        centerline::ends_extended(centerline::pruned(centerline::skeleton_graph(thin)), mask));
    graph = centerline::smoothed(centerline::oriented(graph, {Vec3(51.0, 51.0, 5.0)}).graph);
    benchmark::DoNotOptimize(graph);
  }
  state.counters["object_voxels"] = static_cast<double>(object);
  state.counters["edges"] = static_cast<double>(graph.edges.size());
  core::set_max_threads(0);
}

void skeleton_256_sections(benchmark::State& state) {
  core::set_max_threads(2);
  const imaging::MaskVolume& mask = tree_mask();
  const centerline::SkeletonGraph graph = centerline::smoothed(
      centerline::pruned(centerline::skeleton_graph(centerline::thinned(mask, {.fill_cavities = true}))));
  std::size_t points = 0;
  for (const centerline::SkeletonEdge& e : graph.edges) points += e.points.size();
  for (auto _ : state) benchmark::DoNotOptimize(centerline::measured(graph, mask));
  state.counters["points"] = static_cast<double>(points);
  core::set_max_threads(0);
}

}  // namespace

void add_skeleton_benchmarks() {
  const auto add = [](const char* name, void (*run)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, run)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
  };
  add("skeleton_256", skeleton_256);
  add("skeleton_256_sections", skeleton_256_sections);
}
