// From the surface of a coronary-like tree (marching cubes at 0.25 mm, about 60,000 triangles) to a mesh.
#include "shape_tree.h"

#include "ostia/meshing/caps.h"
#include "ostia/meshing/clip.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/tetrahedralize.h"

#include <benchmark/benchmark.h>

namespace ostia::meshing {
namespace {

constexpr double ratio_for_44k = 0.23;

struct Case {
  geometry::AnalyticShape shape = geometry::coronary_like_tree();
  geometry::VesselTree tree = tree_of(shape);
  geometry::TriMesh open = geometry::surface_of(shape, 0.25, true);
  geometry::TriMesh rounded = geometry::surface_of(shape, 0.25, false);
  geometry::FacedSurface capped = cap_ends(clip_ends(open, tree));
};
const Case& coronary() {
  static const Case made;
  return made;
}
std::vector<double> sizes(double ratio) {
  SizingOptions options;
  options.edge_ratio = ratio;
  return target_edge_lengths(coronary().capped.mesh, TubeFunction(coronary().tree), options);
}

void clip_and_cap(benchmark::State& state) {
  coronary();
  for (auto _ : state) benchmark::DoNotOptimize(cap_ends(clip_ends(coronary().rounded, coronary().tree)));
}

void remesh_coronary(benchmark::State& state) {
  coronary();
  SurfaceQuality quality;
  RemeshReport report;
  for (auto _ : state) {
    const auto result = remesh(coronary().capped, sizes(ratio_for_44k));
    state.PauseTiming();
    quality = surface_quality(result.surface.mesh);
    report = result.report;
    state.ResumeTiming();
  }
  state.counters["triangles_in"] = static_cast<double>(coronary().capped.mesh.triangles.size());
  state.counters["triangles"] = static_cast<double>(quality.triangles);
  state.counters["min_angle_deg"] = quality.min_angle_deg;
  state.counters["mean_min_angle_deg"] = quality.mean_min_angle_deg;
  state.counters["edge_ratio_deviation"] = report.edge_ratio_deviation;
  state.counters["open_edges"] = static_cast<double>(quality.open_edges);
  state.counters["self_intersections"] = static_cast<double>(quality.self_intersections);
}

void tetrahedralize_coronary(benchmark::State& state, double ratio) {
  const auto surface = remesh(coronary().capped, sizes(ratio)).surface;
  TetrahedralizeReport report;
  for (auto _ : state) report = tetrahedralize(surface).report;
  state.counters["triangles_in"] = static_cast<double>(surface.mesh.triangles.size());
  state.counters["tetrahedra"] = static_cast<double>(report.quality.tetrahedra);
  state.counters["min_dihedral_deg"] = report.quality.min_dihedral_deg;
  state.counters["before_mending_deg"] = report.min_dihedral_before_mending_deg;
  state.counters["min_scaled_jacobian"] = report.quality.min_scaled_jacobian;
}

}  // namespace

BENCHMARK(clip_and_cap)->Name("clip and cap five ends of 59k triangles")->Unit(benchmark::kMillisecond);
BENCHMARK(remesh_coronary)
    ->Name("remeshing 59k -> 44k triangles, sized by eq. 9")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(tetrahedralize_coronary, 0, 0.4)
    ->Name("tetrahedra, 14k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(tetrahedralize_coronary, 1, ratio_for_44k)
    ->Name("tetrahedra, 44k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace ostia::meshing

BENCHMARK_MAIN();
