// A frame of playback: the tree at another phase of the heart, in the 2D views and in the 3D scene.

#include "scene_case.h"

#include "ostia/session/beating.h"
#include "ostia/session/workbench.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/tree_scene.h"

#include <benchmark/benchmark.h>
#include <unistd.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

namespace ostia::view {
namespace {

namespace fs = std::filesystem;

constexpr double screen_cell_mm = 0.35;  // of the wall on the screen
constexpr int cage_depth = 4;            // 4,913 control points

/// Twenty phases of a heart that gets smaller and turns about its axis.
geometry::CageMotion beating_heart(const std::vector<Vec3>& points) {
  geometry::CageMotion motion;
  motion.grid = geometry::cage_around(points, cage_depth);
  const Vec3 middle = motion.grid.origin + 0.5 * motion.grid.cells * motion.grid.cell_mm;
  for (int k = 0; k < 20; ++k) {
    geometry::CagePhase phase;
    phase.phase = k / 20.0;
    const double c = 0.5 - 0.5 * std::cos(2.0 * M_PI * (phase.phase - motion.template_phase));
    for (const Vec3& p : geometry::rest_points(motion.grid)) {
      const double turn = 0.15 * c * (p.z() - middle.z()) / 40.0;
      const Vec3 from = (1.0 - 0.12 * c) * (p - middle);
      phase.control_points.push_back(middle + Vec3(std::cos(turn) * from.x() - std::sin(turn) * from.y(),
                                                   std::sin(turn) * from.x() + std::cos(turn) * from.y(),
                                                   from.z()));
    }
    motion.phases.push_back(std::move(phase));
  }
  return motion;
}

/// The full synthetic tree with its case, an image about it, and its motion.
struct BeatingTree {
  fs::path folder;
  session::Workbench bench;
  std::shared_ptr<const session::Beating> beating;
  BeatingTree() {
    std::string name = (fs::temp_directory_path() / "ostia-bench-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder = name;
    const bench::SceneCase made = ostia::bench::scene_case(screen_cell_mm);
    bench.set_session(session::Session(session::CaseFile::create(folder / "case.ostia", *made.model)));
    geometry::TriMesh wall = bench.session().live().wall(screen_cell_mm);
    geometry::Box3 box;
    for (const Vec3& p : wall.points) box.extend(p);
    auto image = std::make_shared<imaging::ImageVolume>();
    image->geometry.size = {256, 256, 256};
    image->geometry.spacing = (box.max() - box.min()) / 255.0;
    image->geometry.origin = box.min();
    image->voxels.assign(static_cast<std::size_t>(image->geometry.voxels()), 100);
    bench.set_image({image, {}});
    const geometry::CageMotion motion = beating_heart(wall.points);
    beating = session::Beating::made(motion, bench.session().file().model(), std::move(wall));
    bench.cursor_mm.set(30.0);
  }
  ~BeatingTree() {
    bench.close_case();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  double triangles() const { return static_cast<double>(beating->wall().triangles.size()); }
};

BeatingTree& tree() {
  static BeatingTree one;
  return one;
}

/// The phase alone: spline, wall and the selected vessel's axis.
void beating_phase(benchmark::State& state) {
  BeatingTree& t = tree();
  int frame = 0;
  for (auto _ : state) {
    const auto shown = t.beating->at(0.017 * ++frame);
    benchmark::DoNotOptimize(shown->axis(t.bench.vessel.get()).curve().get());
  }
  state.counters["triangles"] = t.triangles();
}
BENCHMARK(beating_phase)->Unit(benchmark::kMillisecond)->UseRealTime();

/// All 2D views of a window of 1600 x 1200, image, lines and overlay, at another phase each time.
void beating_2d_views(benchmark::State& state) {
  BeatingTree& t = tree();
  const auto frame_of_both = std::make_shared<CurvedFrame>();
  CurvedView first(t.bench, CurvedView::Which::first, frame_of_both),
      second(t.bench, CurvedView::Which::second, frame_of_both);
  SectionView section(t.bench, 0.0), m2(t.bench, -2.0, 12.0), m1(t.bench, -1.0, 12.0), p1(t.bench, 1.0, 12.0),
      p2(t.bench, 2.0, 12.0);
  SliceView slice(t.bench, SliceKind::axial);
  for (CurvedView* view : {&first, &second}) view->set_size(280, 700, 1.0);
  section.set_size(330, 280, 1.0);
  for (SectionView* view : {&m2, &m1, &p1, &p2}) view->set_size(82, 82, 1.0);
  slice.set_size(330, 280, 1.0);
  const std::vector<PictureView*> views{&first, &second, &section, &m2, &m1, &p1, &p2, &slice};
  int frame = 0;
  for (auto _ : state) {
    t.bench.show_phase(t.beating->at(0.017 * ++frame));
    prepare(views);
    for (PictureView* view : views) benchmark::DoNotOptimize(view->overlay().lines.data());
  }
  t.bench.show_phase(nullptr);
  state.counters["triangles"] = t.triangles();
}
BENCHMARK(beating_2d_views)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The tree in three dimensions, 800 x 600, to the drawn picture.
void beating_scene(benchmark::State& state) {
  BeatingTree& t = tree();
  TreeScene scene;
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetOffScreenRendering(1);
  window->SetSize(800, 600);
  scene.attach(*window);
  scene.set_wall(std::make_shared<const geometry::TriMesh>(t.beating->wall()), *t.bench.model());
  scene.set_pose(scene.pose_from_side(ViewFrom::anterior));
  window->Render();
  int frame = 0;
  for (auto _ : state) {
    const auto shown = t.beating->at(0.017 * ++frame);
    std::vector<std::shared_ptr<const geometry::AxisCurve>> axes;
    for (const auto& vessel : t.bench.model()->vessels) axes.push_back(shown->axis(vessel->vessel).curve());
    scene.move_wall(shown->wall(), axes);
    window->Render();
    window->WaitForCompletion();
  }
  state.counters["triangles"] = t.triangles();
}
BENCHMARK(beating_scene)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace ostia::view
