// A tree of 1.4 million segments, 1024 x 768 pixels, turning, without a window: all of it from afar, and
// close up. What draws stands in the label.

#include "overview.h"

#include "ostia/core/task_context.h"
#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/tree_drawing.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <random>

namespace {

using namespace ostia;
using geometry::Vec3;

constexpr int width = 1024, height = 768;

/// Segments in pairs from a trunk of 100 mm on: each half as long as the one before in three generations.
geometry::VesselGraph grown(std::size_t count) {
  geometry::VesselGraph graph;
  std::mt19937 random(5);
  std::normal_distribution<double> turn(0.0, 0.6);
  graph.points = {Vec3(0.0, 0.0, -50.0), Vec3(0.0, 0.0, 0.0)};
  graph.edges = {{0, 1, 1.5, 1.4}};
  for (std::size_t parent = 0; graph.edges.size() < count; ++parent) {
    const geometry::GraphEdge from = graph.edges[parent];
    const Vec3 at = graph.points[static_cast<std::size_t>(from.to)];
    const Vec3 way = at - graph.points[static_cast<std::size_t>(from.from)];
    for (int child = 0; child < 2; ++child) {
      const Vec3 bent = (way.normalized() + Vec3(turn(random), turn(random), turn(random))).normalized();
      graph.points.push_back(at + 0.8 * way.norm() * bent);
      const double radius = 0.78 * from.radius_to;
      graph.edges.push_back({from.to, static_cast<std::int32_t>(graph.points.size() - 1), radius, radius});
    }
  }
  return graph;
}

std::shared_ptr<const geometry::SegmentBlocks> blocks() {
  static const auto made = std::make_shared<const geometry::SegmentBlocks>(grown(1400000));
  return made;
}

void make_blocks(benchmark::State& state) {
  const geometry::VesselGraph graph = grown(1400000);
  for (auto _ : state) benchmark::DoNotOptimize(geometry::SegmentBlocks(graph).size());
}
BENCHMARK(make_blocks)->Unit(benchmark::kMillisecond);

void tree_picture(benchmark::State& state) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  glview::Offscreen offscreen(width, height);
  glview::TreeDrawing drawing(blocks());
  glview::TreeCamera eye = glview::overview(*blocks(), width, height, static_cast<double>(state.range(0)));
  for (auto _ : state) {
    eye = glview::turned(eye, {5.0, 1.0});
    offscreen.bind();
    glview::begin_part({0, 0, width, height}, {0.0, 0.0, 0.0, 1.0});
    drawing.draw(eye, 1.0, {}, -1);
    offscreen.finish();
  }
  state.counters["pictures_a_second"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["segments"] = static_cast<double>(blocks()->size());
  state.counters["drawn"] = static_cast<double>(drawing.choice().chosen);
  state.SetLabel(glview::renderer_name());
}
BENCHMARK(tree_picture)
    ->ArgName("nearer")
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
