// How long it takes to judge: distances between two surfaces of 200,000 triangles each, and the scores of a
// centerline of 7,450 points.

#include "ostia/core/parallel.h"
#include "ostia/evaluation/centerline_scores.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/analytic_shapes.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>

namespace {

using namespace ostia;

/// A coronary-like tree and the same tree bent and moved a little, as a segmentation of it would lie.
struct Pair {
  geometry::TriMesh reference, result;
};

const Pair& trees() {
  static const Pair pair = [] {
    const geometry::AnalyticShape shape = geometry::coronary_like_tree();
    Pair out{geometry::surface_of(shape, 0.137, true), geometry::surface_of(shape, 0.1371, true)};
    for (geometry::Vec3& p : out.result.points)
      p += geometry::Vec3(0.1 * std::sin(0.7 * p.z()), 0.1 * std::cos(0.5 * p.x()), 0.05);
    return out;
  }();
  return pair;
}

void surface_distance(benchmark::State& state) {
  const Pair& pair = trees();  // made before the clock runs
  core::set_max_threads(2);
  evaluation::SurfaceDistances d;
  for (auto _ : state) {
    d = evaluation::compare_surfaces(pair.reference, pair.result);
    benchmark::DoNotOptimize(d);
  }
  state.counters["triangles"] = static_cast<double>(pair.reference.triangles.size());
  state.counters["msd_mm"] = d.msd_mm;
  core::set_max_threads(0);
}

/// A vessel of 223 mm at steps of 0.03 mm, and the same vessel 0.2 mm aside.
void centerline_overlap(benchmark::State& state) {
  io::RotterdamReference reference;
  std::vector<geometry::Vec3> line;
  for (int i = 0; i < 7450; ++i) {
    const double s = 0.03 * i;
    reference.points.emplace_back(40.0 * std::cos(s / 50.0), 40.0 * std::sin(s / 50.0), 0.6 * s);
    reference.radius.push_back(2.0 - 1.5 * i / 7450.0);
    reference.observer_spread.push_back(0.1);
    line.push_back(reference.points.back() + geometry::Vec3(0.2 * std::sin(0.4 * s), 0.0, 0.1));
  }
  evaluation::CenterlineScores scores;
  for (auto _ : state) {
    scores = evaluation::score_centerline(reference, line);
    benchmark::DoNotOptimize(scores);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_memory_mb"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  state.counters["ov"] = scores.ov;
}

}  // namespace

int main(int argc, char** argv) {
  // First, since the peak of memory is that of the whole program.
  benchmark::RegisterBenchmark("centerline_overlap/7450", centerline_overlap)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
  benchmark::RegisterBenchmark("surface_distance/200k", surface_distance)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
