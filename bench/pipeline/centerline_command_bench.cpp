// `ostia centerline`, from the start of the program to the file that it writes.

#include "shared_data.h"

#include "ostia/core/child_process.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/source.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <optional>

namespace {

using namespace ostia;
namespace fs = std::filesystem;

/// Five ends, 49,000 triangles.
const fs::path& made_surface() {
  static const fs::path file = [] {
    const fs::path path = ostia::testing::temporary_folder("centerline_command") / "lumen.stl";
    io::write_surface(path, geometry::surface_of(geometry::coronary_like_tree(), 0.2775, true));
    return path;
  }();
  return file;
}

std::optional<fs::path> real_surface() {
  return ostia::testing::shared_data("vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
}

void whole_command(benchmark::State& state, const fs::path& surface) {
  const fs::path out = ostia::testing::temporary_folder("centerline_command_out") / "lines.vtp";
  for (auto _ : state) {
    const core::ChildResult done = core::run_child(
        OSTIA_PROGRAM, {"centerline", surface.string(), "-o", out.string(), "--threads", "2"});
    if (!done.ok()) {
      state.SkipWithError("ostia centerline failed");
      return;
    }
  }
}

/// Without the program's start: reading, taking in and axes.
void in_process(benchmark::State& state, const fs::path& surface) {
  pipeline::SourceOptions how;
  how.for_axes = true;
  for (auto _ : state) {
    const pipeline::Source source = pipeline::load(surface, how);
    pipeline::AxesRequest request;
    request.ends = source.ends;
    request.known = source.known;
    request.side_branches = pipeline::SideBranches::asked_only;
    benchmark::DoNotOptimize(pipeline::lumen_axes(source.surface, request));
    state.counters["triangles"] = static_cast<double>(source.surface.triangles.size());
  }
}

void made_whole(benchmark::State& state) {
  whole_command(state, made_surface());
}
void made_in_process(benchmark::State& state) {
  in_process(state, made_surface());
}
void real_whole(benchmark::State& state) {
  if (const auto surface = real_surface())
    whole_command(state, *surface);
  else
    state.SkipWithError("needs shared data: vessels/aneurysm-v4a");
}
void real_in_process(benchmark::State& state) {
  if (const auto surface = real_surface())
    in_process(state, *surface);
  else
    state.SkipWithError("needs shared data: vessels/aneurysm-v4a");
}
BENCHMARK(made_whole)
    ->Name("centerline_command, 49k triangles, 5 ends")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(made_in_process)
    ->Name("centerline_command, 49k triangles, 5 ends, in process")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(real_whole)
    ->Name("centerline_command, real vessel, 44k triangles")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(real_in_process)
    ->Name("centerline_command, real vessel, 44k triangles, in process")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
