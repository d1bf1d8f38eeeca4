// From the surface of a coronary-like tree (marching cubes at 0.25 mm, about 60,000 triangles) to a mesh.
#include "shape_tree.h"

#include "ostia/meshing/boundary_layer.h"
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

void show(benchmark::State& state, const TetrahedralizeReport& report) {
  state.counters["tetrahedra"] = static_cast<double>(report.quality.tetrahedra);
  state.counters["min_dihedral_deg"] = report.quality.min_dihedral_deg;
  state.counters["max_dihedral_deg"] = report.quality.max_dihedral_deg;
  state.counters["before_mending_deg"] = report.min_dihedral_before_mending_deg;
  state.counters["below_10_deg"] = static_cast<double>(report.below_10_deg);
  state.counters["above_12_deg_share"] =
      1.0 - static_cast<double>(report.below_12_deg) / static_cast<double>(report.quality.tetrahedra);
  state.counters["min_scaled_jacobian"] = report.quality.min_scaled_jacobian;
  state.counters["mesher_s"] = report.mesher_seconds;
  state.counters["mending_s"] = report.mending_seconds;
  state.counters["mending_over_mesher"] = report.mending_seconds / report.mesher_seconds;
}

void tetrahedralize_coronary(benchmark::State& state, double ratio, Mesher mesher) {
  const auto surface = remesh(coronary().capped, sizes(ratio)).surface;
  TetrahedralizeOptions options;
  options.mesher = mesher;
  TetrahedralizeReport report;
  for (auto _ : state) report = tetrahedralize(surface, options).report;
  state.counters["triangles_in"] = static_cast<double>(surface.mesh.triangles.size());
  if (report.surface_meshed_anew) state.counters["deviation_mm"] = report.surface_deviation_mm;
  show(state, report);
}

void fill_layers_of_coronary(benchmark::State& state, int layers, double thickness) {
  const auto surface = remesh(coronary().capped, sizes(ratio_for_44k)).surface;
  BoundaryLayerOptions options;
  options.layers = layers;
  options.thickness = thickness;
  TetrahedralizeReport report;
  for (auto _ : state) report = fill_with_layers(surface, options).tetrahedra;
  show(state, report);
}

}  // namespace

BENCHMARK(clip_and_cap)->Name("clip and cap five ends of 59k triangles")->Unit(benchmark::kMillisecond);
BENCHMARK(remesh_coronary)
    ->Name("remeshing 59k -> 44k triangles, sized by eq. 9")
    ->Unit(benchmark::kSecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(tetrahedralize_coronary, 0, 0.4, Mesher::tetgen)
    ->Name("tetrahedra, 14k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(tetrahedralize_coronary, 1, ratio_for_44k, Mesher::tetgen)
    ->Name("tetrahedra, 44k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(fill_layers_of_coronary, 0, 3, 1.0)
    ->Name("three layers of prisms and tetrahedra, 44k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(tetrahedralize_coronary, 2, 0.4, Mesher::mesh3)
    ->Name("tetrahedra by the second mesher, 14k triangles")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace ostia::meshing

BENCHMARK_MAIN();
