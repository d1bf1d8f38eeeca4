// A bush of 1.4 million segments, 1024 x 768 pixels, without a window: with as many segments as the picture
// needs, and with all that lie in it.

#include "test_bush.h"

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/tree_drawing.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

namespace {

using namespace ostia;

constexpr int width = 1024, height = 768;

std::shared_ptr<const geometry::SegmentBlocks> bush() {
  static const auto one = std::make_shared<const geometry::SegmentBlocks>(glview::test_bush(1'400'000));
  return one;
}

void tree_detail(benchmark::State& state) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  glview::Offscreen offscreen(width, height);
  glview::TreeDrawing drawing(bush());
  if (state.range(1) != 0) drawing.set_most(geometry::SegmentBlocks::everything);
  glview::TreeEye eye;
  eye.width_px = width;
  eye.height_px = height;
  eye = glview::fitted(eye, bush()->low(), bush()->high());
  eye.distance_mm /= static_cast<double>(state.range(0));
  for (auto _ : state) {
    eye = glview::turned(eye, {3.0, 1.0});
    offscreen.bind();
    glview::begin_part({0, 0, width, height}, {1.0, 1.0, 1.0, 1.0});
    drawing.draw(eye, 1.0, {}, -1);
    offscreen.finish();
  }
  state.counters["pictures_a_second"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["drawn"] = static_cast<double>(drawing.choice().chosen);
  state.SetLabel(glview::renderer_name());
}
BENCHMARK(tree_detail)
    ->ArgNames({"nearer", "everything"})
    ->ArgsProduct({{1, 8, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
