// A click into a bush of 1.4 million segments: which segment lies under it, its facts, and the picture that
// shows it highlighted. 1024 x 768 pixels, places over the middle half of the picture.

#include "overview.h"
#include "test_bush.h"

#include "ostia/analysis/tree_ruler.h"
#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/tree_drawing.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

namespace {

using namespace ostia;
using geometry::Vec2;

constexpr int width = 1024, height = 768;

struct Bush {
  std::shared_ptr<const geometry::VesselGraph> graph =
      std::make_shared<const geometry::VesselGraph>(glview::test_bush(1'400'000));
  analysis::TreeRuler ruler{graph};
  analysis::TreeRays rays{graph};
  std::shared_ptr<const geometry::SegmentBlocks> blocks =
      std::make_shared<const geometry::SegmentBlocks>(*graph);

  static const Bush& one() {
    static const Bush made;
    return made;
  }
  glview::TreeCamera eye(double nearer) const { return glview::overview(*blocks, width, height, nearer); }
};

/// The next place is another one.
struct Clicks {
  unsigned at = 0;
  Vec2 next() {
    ++at;
    return {width / 4.0 + at * 97 % (width / 2), height / 4.0 + at * 61 % (height / 2)};
  }
};

/// -1: nothing is there.
std::int32_t pick(const Bush& bush, const glview::TreeCamera& eye, const Vec2& at) {
  const glview::CameraRay ray = eye.ray(at);
  const auto hit = bush.rays.first({ray.origin, ray.direction, ray.pixel});
  if (!hit) return -1;
  benchmark::DoNotOptimize(bush.ruler.facts(hit->place.edge));
  return hit->place.edge;
}

void tree_pick(benchmark::State& state) {
  const Bush& bush = Bush::one();
  const glview::TreeCamera eye = bush.eye(static_cast<double>(state.range(0)));
  Clicks clicks;
  std::size_t found = 0;
  for (auto _ : state) found += pick(bush, eye, clicks.next()) >= 0 ? 1 : 0;
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}
BENCHMARK(tree_pick)->ArgName("nearer")->Arg(1)->Arg(8)->Arg(100)->Unit(benchmark::kMillisecond);

void tree_pick_and_highlight(benchmark::State& state) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  const Bush& bush = Bush::one();
  const glview::TreeCamera eye = bush.eye(static_cast<double>(state.range(0)));
  glview::Offscreen offscreen(width, height);
  glview::TreeDrawing drawing(bush.blocks);
  Clicks clicks;
  for (auto _ : state) {
    const std::int32_t edge = pick(bush, eye, clicks.next());
    offscreen.bind();
    glview::begin_part({0, 0, width, height}, {1.0, 1.0, 1.0, 1.0});
    drawing.draw(eye, 1.0, {}, edge);
    offscreen.finish();
  }
  state.SetLabel(glview::renderer_name());
}
BENCHMARK(tree_pick_and_highlight)
    ->ArgName("nearer")
    ->Arg(1)
    ->Arg(8)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
