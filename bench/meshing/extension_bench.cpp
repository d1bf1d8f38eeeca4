// Flow extensions of a coronary-like tree (marching cubes at 0.25 mm, needles and all).
#include "shape_tree.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/flow_extension.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace ostia::meshing {
namespace {

void extend_coronary(benchmark::State& state) {
  const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  const geometry::VesselTree tree = tree_of(shape);
  const ClippedSurface clipped = clip_ends(geometry::raw_surface_of(shape, 0.25, false), tree);
  ExtendedEnds out;
  for (auto _ : state) out = extend_ends(clipped, tree);
  double seam = 180.0, area = 0.0;
  for (const FlowExtension& e : out.extensions) {
    seam = std::min(seam, e.seam_angle_deg);
    area = std::max(area, std::abs(e.end_area_mm2 / e.section_area_mm2 - 1.0));
  }
  state.counters["extensions"] = static_cast<double>(out.extensions.size());
  state.counters["triangles"] = static_cast<double>(out.surface.mesh.triangles.size());
  state.counters["seam_angle_deg"] = seam;
  state.counters["area_off"] = area;
  state.counters["self_intersections"] =
      static_cast<double>(geometry::self_intersections(out.surface.mesh).size());
}

}  // namespace

BENCHMARK(extend_coronary)
    ->Name("flow extensions at five ends of 59k triangles")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace ostia::meshing
