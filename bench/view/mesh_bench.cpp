// A mesh of a million tetrahedra in 3D: made ready, cut, and drawn.
#include "../../tests/view/grid_mesh.h"

#include "ostia/meshing/element_measures.h"
#include "ostia/view/mesh_scene.h"
#include "ostia/view/tree_scene.h"

#include <benchmark/benchmark.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <memory>

namespace ostia::view {
namespace {

constexpr double cube_mm = 0.1;

/// As long and thin as arteries are: 10 x 10 x 1667 cubes of six tetrahedra, 1,000,200, with 133,760 sides on
/// their boundary.
std::shared_ptr<const geometry::MixedMesh> million() {
  static const auto mesh = testing::grid_of_cubes(10, 10, 1667, cube_mm);
  return mesh;
}

std::shared_ptr<const ShownMesh> million_shown() {
  static const auto shown = prepared(million());
  return shown;
}

MeshCut cut_at(double share) {
  return {{5.0 * cube_mm, 5.0 * cube_mm, 1667.0 * cube_mm * share}, {0.3, 0.2, 1.0}};
}

void PrepareMillion(benchmark::State& state) {
  const auto mesh = million();
  for (auto _ : state) benchmark::DoNotOptimize(prepared(mesh));
}
BENCHMARK(PrepareMillion)->Unit(benchmark::kMillisecond)->UseRealTime();

void MeasureMillion(benchmark::State& state) {
  const auto mesh = million();
  for (auto _ : state) benchmark::DoNotOptimize(meshing::element_measures(*mesh));
}
BENCHMARK(MeasureMillion)->Unit(benchmark::kMillisecond)->UseRealTime();

void CutMillion(benchmark::State& state) {
  const auto shown = million_shown();
  double share = 0.3;
  std::size_t sides = 0;
  for (auto _ : state) sides = shell_of(*shown, cut_at(share = share < 0.7 ? share + 0.05 : 0.3)).size();
  state.counters["sides"] = static_cast<double>(sides);
}
BENCHMARK(CutMillion)->Unit(benchmark::kMillisecond)->UseRealTime();

/// One step of the slider: cut, coloured, drawn.
void CutAndDrawMillion(benchmark::State& state) {
  TreeScene scene;
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(1);
  window->SetSize(800, 800);
  scene.attach(*window);
  const auto mesh = std::make_shared<MeshScene>(million_shown());
  mesh->set_values(std::make_shared<std::vector<double>>(million()->tetrahedra.size(), 0.4), {"q", 0.0, 1.0});
  scene.set_guest(mesh);
  scene.set_pose(pose_from(ViewFrom::anterior, {0, 0, 83}, 85.0));
  window->Render();
  double share = 0.3;
  for (auto _ : state) {
    mesh->set_cut(cut_at(share = share < 0.7 ? share + 0.05 : 0.3));
    window->Render();
    window->WaitForCompletion();
  }
  scene.set_guest(nullptr);
}
BENCHMARK(CutAndDrawMillion)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ostia::view
