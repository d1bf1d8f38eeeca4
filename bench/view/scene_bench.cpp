// The 3D scene: a wall handed over and drawn, a picture while the camera turns, a pick.

#include "scene_case.h"

#include "ostia/imaging/reduced_volume.h"
#include "ostia/view/tree_scene.h"

#include <benchmark/benchmark.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <map>
#include <memory>

namespace {

using namespace ostia;

/// A tree of about 40,000, 100,000 and 200,000 triangles.
const bench::SceneCase& tree(int cell_um) {
  static std::map<int, bench::SceneCase> made;
  const auto found = made.find(cell_um);
  return found != made.end() ? found->second
                             : made.emplace(cell_um, bench::scene_case(cell_um / 1000.0)).first->second;
}

struct Shown {
  view::TreeScene scene;
  vtkNew<vtkRenderWindow> window;
  Shown(int width, int height) {
    window->SetMultiSamples(0);
    window->SetOffScreenRendering(1);
    window->SetSize(width, height);
    scene.attach(*window);
  }
  void render() {
    window->Render();
    window->WaitForCompletion();
  }
};

void scene_wall(benchmark::State& state) {
  const bench::SceneCase& of = tree(static_cast<int>(state.range(0)));
  Shown shown(800, 600);
  shown.scene.set_wall(of.wall, *of.model);
  shown.scene.set_pose(shown.scene.pose_from_side(view::ViewFrom::anterior));
  shown.render();
  for (auto _ : state) shown.scene.set_wall(of.wall, *of.model);
  state.counters["triangles"] = static_cast<double>(of.wall->triangles.size());
}
BENCHMARK(scene_wall)->Arg(500)->Arg(320)->Arg(225)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The upload alone: what a picture takes after a new wall, beyond one of the wall that was there.
void scene_wall_and_picture(benchmark::State& state) {
  const bench::SceneCase& of = tree(static_cast<int>(state.range(0)));
  Shown shown(800, 600);
  for (auto _ : state) {
    shown.scene.set_wall(of.wall, *of.model);
    shown.render();
  }
  state.counters["triangles"] = static_cast<double>(of.wall->triangles.size());
}
BENCHMARK(scene_wall_and_picture)->Arg(500)->Arg(320)->Arg(225)->Unit(benchmark::kMillisecond)->UseRealTime();

void scene_turned(benchmark::State& state) {
  const bench::SceneCase& of = tree(static_cast<int>(state.range(0)));
  Shown shown(800, 600);
  shown.scene.set_wall(of.wall, *of.model);
  shown.scene.set_pose(shown.scene.pose_from_side(view::ViewFrom::anterior));
  shown.render();
  for (auto _ : state) {
    shown.scene.rotate_by(4.0, 1.0);
    shown.render();
  }
  state.counters["triangles"] = static_cast<double>(of.wall->triangles.size());
}
BENCHMARK(scene_turned)->Arg(500)->Arg(320)->Arg(225)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Voxels along each axis; 0 while the camera moves, 1 as fine as 120 ms allow.
void scene_volume(benchmark::State& state) {
  const bench::SceneCase& of = tree(500);
  const auto side = static_cast<std::int64_t>(state.range(0));
  auto image = std::make_shared<imaging::ImageVolume>();
  image->geometry.size = {side, side, side};
  image->geometry.spacing = view::Vec3::Constant(140.0 / static_cast<double>(side));
  geometry::Box3 box;
  for (const auto& point : of.wall->points) box.extend(point);
  image->geometry.origin = box.center() - view::Vec3::Constant(70.0);
  image->voxels.assign(static_cast<std::size_t>(side * side * side), -80);
  for (std::int64_t i = 0; i < image->geometry.voxels(); ++i) {
    const view::Vec3 index(static_cast<double>(i % side), static_cast<double>(i / side % side),
                           static_cast<double>(i / side / side));
    const double away =
        (index - view::Vec3::Constant(0.5 * static_cast<double>(side))).norm() / static_cast<double>(side);
    image->voxels[static_cast<std::size_t>(i)] = away < 0.2 ? 380 : away < 0.35 ? 110 : -80;
  }
  Shown shown(800, 600);
  shown.scene.set_wall(of.wall, *of.model);
  shown.scene.set_volume(image);
  shown.scene.set_volume_mode(view::VolumeMode::rendering);
  shown.scene.set_pose(shown.scene.pose_from_side(view::ViewFrom::anterior));
  if (state.range(1) == 0) shown.scene.set_interacting(true);
  shown.render();
  while (shown.scene.refine()) shown.render();
  for (auto _ : state) {
    shown.scene.rotate_by(4.0, 1.0);
    shown.render();
  }
}
BENCHMARK(scene_volume)
    ->Args({128, 0})
    ->Args({128, 1})
    ->Args({192, 0})
    ->Args({192, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void scene_pick(benchmark::State& state) {
  const bench::SceneCase& of = tree(320);
  Shown shown(800, 600);
  shown.scene.set_wall(of.wall, *of.model);
  shown.scene.set_pose(shown.scene.pose_from_side(view::ViewFrom::anterior));
  const geometry::Vec2 at = shown.scene.project(of.model->vessels[0]->axis->point(30.0));
  for (auto _ : state) benchmark::DoNotOptimize(shown.scene.pick(at));
}
BENCHMARK(scene_pick)->Unit(benchmark::kMillisecond)->UseRealTime();

void reduced_volume(benchmark::State& state) {
  imaging::ImageVolume image;
  image.geometry.size = {512, 512, 300};
  image.voxels.assign(static_cast<std::size_t>(image.geometry.voxels()), 100);
  for (auto _ : state) benchmark::DoNotOptimize(imaging::reduced_volume(image));
}
BENCHMARK(reduced_volume)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
