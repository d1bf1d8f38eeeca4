// A bush of 1.4 million segments, 1024 x 768 pixels, without a window: with as many segments as the picture
// needs, and with all that lie in it.

#include "overview.h"
#include "test_bush.h"

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/tree_drawing.h"
#include "ostia/io/graph_file.h"

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace {

using namespace ostia;

constexpr int width = 1024, height = 768;

std::shared_ptr<const geometry::SegmentBlocks> bush() {
  static const auto one = std::make_shared<const geometry::SegmentBlocks>(glview::test_bush(1'400'000));
  return one;
}

void draw_turning(benchmark::State& state, const std::shared_ptr<const geometry::SegmentBlocks>& blocks) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  glview::Offscreen offscreen(width, height);
  glview::TreeDrawing drawing(blocks);
  if (state.range(1) != 0) drawing.set_most(geometry::SegmentBlocks::everything);
  glview::TreeCamera eye = glview::overview(*blocks, width, height, static_cast<double>(state.range(0)));
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
  state.counters["hidden"] = static_cast<double>(drawing.choice().hidden);
  state.SetLabel(glview::renderer_name());
}

void tree_detail(benchmark::State& state) {
  draw_turning(state, bush());
}
BENCHMARK(tree_detail)
    ->ArgNames({"nearer", "everything"})
    ->ArgsProduct({{1, 2, 4, 8, 16, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void tree_of_ten_million(benchmark::State& state) {
  static const auto blocks = std::make_shared<const geometry::SegmentBlocks>(glview::test_bush(10'000'000));
  draw_turning(state, blocks);
}
BENCHMARK(tree_of_ten_million)
    ->ArgNames({"nearer", "everything"})
    ->ArgsProduct({{1, 4, 16, 100}, {0}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// Any tree, as ostia grow makes them: OSTIA_TREE=grown.vtp.
void tree_file(benchmark::State& state) {
  const char* path = std::getenv("OSTIA_TREE");
  if (path == nullptr) {
    state.SkipWithError("OSTIA_TREE names no file");
    return;
  }
  static const auto blocks = std::make_shared<const geometry::SegmentBlocks>(io::read_graph(path).graph);
  draw_turning(state, blocks);
}
BENCHMARK(tree_file)
    ->ArgNames({"nearer", "everything"})
    ->ArgsProduct({{1, 2, 4, 8, 16, 100}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
