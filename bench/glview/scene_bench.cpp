// The beating tree, 10,600 vertices, 4,913 control points: a picture a phase, without a window, and what
// comes before the first one. What draws stands in the label.

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/offscreen.h"
#include "ostia/glview/sample_motion.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

glview::ShownSurface with_directions(glview::ShownSurface surface) {
  surface.along = glview::find_directions(surface);
  return surface;
}

struct Heart {
  glview::SampleHeart heart = glview::sample_heart();
  glview::ShownSurface surface = with_directions(glview::shown_surface(heart.surface, heart.motion.grid));
  motion::MovingCage cage{heart.motion};
  glview::BendingTable bending = glview::bending_table(surface, cage);
};

const Heart& heart() {
  static const Heart one;
  return one;
}

/// One a phase.
void pictures(benchmark::State& state, int width, int height) {
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

void beating_scene(benchmark::State& state) {
  pictures(state, 1024, 768);
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

void beating_scene_1600x1200(benchmark::State& state) {
  pictures(state, 1600, 1200);
}
BENCHMARK(beating_scene_1600x1200)
    ->ArgNames({"value", "x_ray"})
    ->Args({0, 0})
    ->Args({3, 0})
    ->Args({0, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// All that is done with a heart that has been read until its first picture is there.
void first_picture(benchmark::State& state) {
  if (const std::string why = glview::offscreen_trouble(); !why.empty()) {
    state.SkipWithError(why.c_str());
    return;
  }
  const glview::SampleHeart& read = heart().heart;
  const glview::Viewport all{0, 0, 1600, 1200};
  glview::Offscreen offscreen(all.width, all.height);
  offscreen.bind();
  for (auto _ : state) {
    const motion::MovingCage cage(read.motion);
    glview::BeatingScene scene(glview::shown_surface(read.surface, read.motion.grid), cage);
    scene.set_phase(0.4);
    scene.draw(glview::camera_on(read.surface.points, {30.0, 20.0}, all.aspect()), {}, all);
    offscreen.finish();
  }
  state.SetLabel(glview::renderer_name());
}
BENCHMARK(first_picture)->Unit(benchmark::kMillisecond)->UseRealTime();

/// What stretch and curvature ask for beyond that.
void directions_along_the_vessel(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(glview::find_directions(heart().surface));
}
BENCHMARK(directions_along_the_vessel)->Unit(benchmark::kMillisecond);

/// The part of a picture that is not the graphics card's: all control points by the splines.
void control_points_of_a_phase(benchmark::State& state) {
  double phase = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(heart().cage.at(phase += 0.013));
}
BENCHMARK(control_points_of_a_phase)->Unit(benchmark::kMicrosecond);

}  // namespace
