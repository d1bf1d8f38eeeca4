// What the 2D views cost between an event of the mouse and a picture ready to be painted.

#include "ostia/lumen/start_surface.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"
#include "ostia/view/pointer.h"
#include "ostia/view/profile_view.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace ostia::view {
namespace {

namespace fs = std::filesystem;

constexpr double radius_mm = 1.5;

/// A bent tube with so long an axis that about 1,000 samples lie on it.
geometry::VesselTree bent_vessel() {
  geometry::Centerline axis;
  for (int i = 0; i <= 240; ++i) {
    const double t = i / 240.0;
    axis.points.emplace_back(20.0 * std::sin(2.0 * t), 20.0 * std::cos(2.0 * t), 85.0 * t);
    axis.radius.push_back(radius_mm);
  }
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, axis}};
  tree.vessels = {{0, "LAD", {0}}};
  return tree;
}

session::OpenImage plain_image() {
  auto volume = std::make_shared<imaging::ImageVolume>();
  volume->geometry.size = {256, 256, 300};
  volume->geometry.spacing = {0.4, 0.4, 0.4};
  volume->geometry.origin = {-51.0, -51.0, -15.0};
  volume->voxels.resize(static_cast<std::size_t>(volume->geometry.voxels()));
  for (std::size_t i = 0; i < volume->voxels.size(); ++i)
    volume->voxels[i] = static_cast<std::int16_t>(static_cast<int>(i * 2654435761U % 400U) - 100);
  return {volume, {std::string(64, 'a'), "image-bench"}};
}

struct Window {
  fs::path folder;
  session::Workbench bench;
  std::shared_ptr<CurvedFrame> frame = std::make_shared<CurvedFrame>();
  CurvedView first{bench, CurvedView::Which::first, frame}, second{bench, CurvedView::Which::second, frame};
  SectionView section{bench, 0.0}, before{bench, -1.0}, after{bench, 1.0};
  SliceView slice{bench, SliceKind::axial};
  ProfileView profile{bench};
  Pointer hand{first};
  Window() {
    std::string name = (fs::temp_directory_path() / "ostia-bench-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    folder = name;
    bench.set_image(plain_image());
    bench.set_session(session::Session(session::CaseFile::create(
        folder / "case.ostia", lumen::model_of_tubes(bent_vessel()), bench.image().reference)));
    // The sizes that these views have in a window of 1600 x 1200.
    first.set_size(280, 700, 1.0);
    second.set_size(280, 700, 1.0);
    section.set_size(330, 280, 1.0);
    before.set_size(82, 82, 1.0);
    after.set_size(82, 82, 1.0);
    slice.set_size(330, 280, 1.0);
    profile.set_size(1600, 140, 1.0);
    bench.cursor_mm.set(40.0);
    all();
  }
  ~Window() {
    bench.close_case();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
  void show(PictureView& view) {
    benchmark::DoNotOptimize(view.image().values.data());
    benchmark::DoNotOptimize(view.overlay().lines.data());
  }
  void others() {
    for (PictureView* view : {static_cast<PictureView*>(&second), static_cast<PictureView*>(&section),
                              static_cast<PictureView*>(&before), static_cast<PictureView*>(&after),
                              static_cast<PictureView*>(&slice)})
      show(*view);
    benchmark::DoNotOptimize(profile.overlay().lines.data());
  }
  void all() {
    show(first);
    others();
  }
  double samples() const { return static_cast<double>(bench.model()->vessels.front()->samples.size()); }
};

Window& window() {
  static Window one;
  return one;
}

void drag(benchmark::State& state, bool with_others) {
  Window& w = window();
  w.bench.tool.set(session::Tool::drag);
  const double s = 40.0;
  const Vec2 wall =
      w.first.project(w.bench.axis()->place(s, w.first.theta_deg() * M_PI / 180.0, radius_mm))->px;
  w.hand.press({wall, Button::left});
  int step = 0;
  for (auto _ : state) {
    const double by = 3.0 + 3.0 * (step++ % 4);
    w.hand.move({wall + Vec2(by, 0.0), Button::left});
    w.show(w.first);
    if (with_others) w.others();
  }
  w.hand.release({wall + Vec2(3.0, 0.0), Button::left});
  w.bench.undo();
  w.all();
  state.counters["samples"] = w.samples();
}

/// A move of the mouse while the wall is pulled, to the dragged view's new lines.
void drag_to_dragged_view(benchmark::State& state) {
  drag(state, false);
}
BENCHMARK(drag_to_dragged_view)->Unit(benchmark::kMillisecond);

/// The same to all 2D views, the profile measured again.
void drag_to_all_views(benchmark::State& state) {
  drag(state, true);
}
BENCHMARK(drag_to_all_views)->Unit(benchmark::kMillisecond);

/// Both CPRs turned: images and lines anew.
void rotate_cprs(benchmark::State& state) {
  Window& w = window();
  for (auto _ : state) {
    w.bench.theta_deg.set(std::remainder(w.bench.theta_deg.get() + 2.0, 360.0));
    w.show(w.first);
    w.show(w.second);
  }
}
BENCHMARK(rotate_cprs)->Unit(benchmark::kMillisecond);

/// The cursor moved along the vessel: sections and slice anew, lines in all views.
void move_cursor(benchmark::State& state) {
  Window& w = window();
  int step = 0;
  for (auto _ : state) {
    w.bench.cursor_mm.set(30.0 + 0.5 * (step++ % 40));
    w.all();
  }
}
BENCHMARK(move_cursor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ostia::view
