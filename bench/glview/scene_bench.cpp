// The beating tree, 1024 x 768 pixels, 10,600 vertices, 4,913 control points: a picture a phase, without a
// window. What draws stands in the label.

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/sample_motion.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

constexpr int width = 1024, height = 768;

struct Heart {
  glview::SampleHeart heart = glview::sample_heart();
  glview::ShownSurface surface = glview::shown_surface(heart.surface, heart.motion.grid);
  motion::MovingCage cage{heart.motion};
  glview::BendingTable bending = glview::bending_table(surface, cage);
};

const Heart& heart() {
  static const Heart one;
  return one;
}

void beating_scene(benchmark::State& state) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  glview::Offscreen offscreen(width, height);
  glview::BeatingScene scene(heart().surface, heart().cage);
  scene.set_bending(heart().bending);
  glview::SceneLook look;
  look.value = static_cast<glview::SurfaceValue>(state.range(0));
  look.range = glview::value_range(heart().surface, heart().cage, look.value, &heart().bending);
  const glview::Viewport all{0, 0, width, height};
  glview::Camera camera = glview::camera_on(heart().heart.surface.points, {30.0, 20.0}, all.aspect());
  if (state.range(1) != 0) camera.projection = glview::Projection::x_ray;
  offscreen.bind();
  double phase = 0.0;
  for (auto _ : state) {
    phase += 0.013;
    scene.set_phase(phase);
    scene.draw(camera, look, all);
    offscreen.finish();
  }
  state.counters["pictures_a_second"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["vertices"] = static_cast<double>(heart().surface.vertices.size());
  state.counters["control_points"] = static_cast<double>(heart().cage.grid().point_count());
  state.SetLabel(glview::renderer_name());
}
BENCHMARK(beating_scene)
    ->ArgNames({"value", "x_ray"})
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({3, 0})
    ->Args({4, 0})
    ->Args({0, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// The part of a picture that is not the graphics card's: all control points by the splines.
void control_points_of_a_phase(benchmark::State& state) {
  double phase = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(heart().cage.at(phase += 0.013));
}
BENCHMARK(control_points_of_a_phase)->Unit(benchmark::kMicrosecond);

}  // namespace
