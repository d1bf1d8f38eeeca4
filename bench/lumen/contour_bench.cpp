// Contour lines of a vessel of 1,000 samples (support 3 mm) on both 512 x 512 straightened reformations and a
// 512 x 512 cross-section: brought up to date after an edit of 12 samples, and all anew when the reformations
// are rotated. p95 over the iterations, of the time on the clock and of the processor's time in all threads.

#include "tube_samples.h"

#include "ostia/core/parallel.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/view_contours.h"
#include "ostia/lumen/views.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <vector>

namespace {

using namespace ostia;
using lumen::Box3;
using lumen::Vec2;
using lumen::Vec3;

constexpr int pixels = 512;

const lumen::VesselLumen& vessel() {
  static const lumen::VesselLumen made = [] {
    lumen::VesselLumen v = lumen::testing::tube_vessel(
        lumen::testing::bent_axis(110.0), [](double, double) { return 1.5; }, 1.08);
    v.interpolation.support_radius_mm = 3.0;
    return v;
  }();
  return made;
}

struct Views {
  std::vector<std::unique_ptr<lumen::ViewContours>> kept;
  std::vector<lumen::ViewContours*> all;

  Views(double theta_deg, double cross_section_mm) {
    reformat::CurvedOptions options;
    options.theta_deg = theta_deg;
    options.pixel_mm = 0.25;
    options.s_start_mm = -9.0;
    options.width = options.height = pixels;
    const reformat::CurvedReformation cpr(vessel().axis, options), twin = cpr.twin();
    const reformat::Plane plane =
        reformat::cross_section_plane(*vessel().axis, cross_section_mm, 15.0, 15.0 / pixels);
    add(lumen::view_of(cpr), cpr.axis_px());
    add(lumen::view_of(twin), twin.axis_px());
    add(lumen::view_of(plane), {Vec2(0.5 * pixels, 0.5 * pixels)});
  }
  void add(const lumen::ViewSurface& view, const std::vector<Vec2>& seeds) {
    kept.push_back(std::make_unique<lumen::ViewContours>(view, seeds));
    all.push_back(kept.back().get());
  }
  void update(const lumen::ScalarField& field, const Box3& changed) {
    lumen::update_views(all, field, changed);
  }
  double evaluations() const {
    double sum = 0.0;
    for (const auto& view : kept) sum += static_cast<double>(view->evaluations());
    return sum;
  }
};

/// Edits of 12 neighbouring samples, pushed in or out from where the tube has them.
class Editor {
 public:
  Editor() : surface_(vessel()), current_(vessel().samples) {}
  const lumen::IncrementalSurface& surface() const { return surface_; }
  double edited_at_mm() const { return at_mm_; }
  lumen::IncrementalReport edit() {
    const Vec3 centre = current_[random_() % current_.size()].position;
    std::partial_sort(current_.begin(), current_.begin() + 12, current_.end(),
                      [&](const lumen::SurfaceSample& a, const lumen::SurfaceSample& b) {
                        return (a.position - centre).squaredNorm() < (b.position - centre).squaredNorm();
                      });
    const double push = 0.2 * (static_cast<double>(random_() >> 11) * 0x1p-53 - 0.5);
    std::vector<std::int64_t> removed;
    std::vector<lumen::SurfaceSample> added;
    for (std::size_t i = 0; i < 12; ++i) {
      removed.push_back(current_[i].id);
      current_[i].id = next_id_++;
      current_[i].position += push * current_[i].normal;
      current_[i].origin = lumen::SampleOrigin::edit;
      added.push_back(current_[i]);
    }
    at_mm_ = current_[0].s_mm;
    return surface_.change(removed, added);
  }

 private:
  lumen::IncrementalSurface surface_;
  std::vector<lumen::SurfaceSample> current_;
  std::mt19937_64 random_{5};
  std::int64_t next_id_ = 1000000;
  double at_mm_ = 0.0;
};

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

class Times {
 public:
  template <class Work>
  void measure(benchmark::State& state, const Work& work) {
    const double processor = processor_ms();
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    processor_.push_back(processor_ms() - processor);
    clock_.push_back(1e3 * seconds.count());
    state.SetIterationTime(seconds.count());
  }
  void report(benchmark::State& state) {
    state.counters["p95_ms"] = p95(clock_);
    state.counters["p95_processor_ms"] = p95(processor_);
    state.counters["samples"] = static_cast<double>(vessel().samples.size());
  }

 private:
  std::vector<double> clock_, processor_;
  static double p95(std::vector<double>& of) {
    std::sort(of.begin(), of.end());
    return of[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(of.size()))) - 1];
  }
};

void after_an_edit(benchmark::State& state) {
  core::set_max_threads(0);
  Editor editor;
  Times times;
  double evaluations = 0.0, length = 0.0;
  for (auto _ : state) {
    const auto before = editor.surface().surface();
    const lumen::IncrementalReport report = editor.edit();
    Views views(30.0, std::clamp(editor.edited_at_mm(), 0.0, vessel().axis->length()));
    views.update(*before, Box3());
    times.measure(state, [&] { views.update(*editor.surface().surface(), report.changed); });
    evaluations += views.evaluations();
    length += report.changed_to_mm - report.changed_from_mm;
  }
  times.report(state);
  state.counters["evaluations"] = evaluations / static_cast<double>(state.iterations());
  state.counters["changed_mm"] = length / static_cast<double>(state.iterations());
}

void anew(benchmark::State& state) {
  core::set_max_threads(0);
  const lumen::ImplicitSurface field = solve(vessel());
  Times times;
  double theta = 0.0, evaluations = 0.0;
  for (auto _ : state) {
    theta += 7.0;
    times.measure(state, [&] {
      Views views(theta, 55.0);
      views.update(field, Box3());
      evaluations += views.evaluations();
    });
  }
  times.report(state);
  state.counters["evaluations"] = evaluations / static_cast<double>(state.iterations());
}

void evaluate_band(benchmark::State& state) {
  core::set_max_threads(static_cast<int>(state.range(0)));
  const lumen::ImplicitSurface field = solve(vessel());
  std::vector<Vec3> places;
  for (int row = 0; row < 438; ++row)
    for (int column = 0; column < 240; ++column)
      places.push_back(vessel().axis->place(row * 0.25, 0.3, (column - 119.5) * 0.025));
  std::vector<double> values(places.size());
  for (auto _ : state) field.values(places, values);
  state.counters["places"] = static_cast<double>(places.size());
  core::set_max_threads(0);
}

}  // namespace

BENCHMARK(after_an_edit)
    ->Name("contours on two 512x512 CPRs and a cross-section after an edit of 12 samples (p95 <= 5 ms)")
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(anew)
    ->Name("contours on two 512x512 CPRs and a cross-section all anew (p95 <= 10 ms)")
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate_band)
    ->Name("f at 105,000 places of a CPR's band, threads")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
