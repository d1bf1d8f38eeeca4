// The report of a whole synthetic case, 512 x 512 x 300 voxels and its ten vessels as they are found: from
// the start of the program to the folder on the disk, and its stages with everything in memory.

#include "full_case.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/session/case_report.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace ostia;

/// The case as `ostia extract` makes it of the whole image.
const std::filesystem::path& found_case() {
  static const std::filesystem::path file = [] {
    const std::filesystem::path made = ostia::testing::temporary_folder("bench") / "heart.ostia";
    const auto image = bench::full_case() / "image00.nrrd";
    if (bench::run_ostia({"extract", image.string(), "-o", made.string()}).code != 0)
      throw InvalidInput("no case was made of " + image.string());
    return made;
  }();
  return file;
}

std::filesystem::path next_folder() {
  static int number = 0;
  return found_case().parent_path() / ("report" + std::to_string(number++));
}

void report_program(benchmark::State& state) {
  const std::filesystem::path image = bench::full_case() / "image00.nrrd";
  found_case();
  for (auto _ : state) {
    const bench::Finished done = bench::run_ostia(
        {"report", found_case().string(), "--image", image.string(), "-o", next_folder().string()});
    if (done.code != 0) return state.SkipWithError("it was refused");
    state.SetIterationTime(done.seconds);
    state.counters["cpu_s"] = done.cpu_seconds;
    state.counters["peak_mb"] = done.peak_mb;
  }
}
BENCHMARK(report_program)->Name("Report, NRRD and case to folder")->Unit(benchmark::kSecond)->UseManualTime();

/// Everything that a stage needs of those before it.
struct Stages {
  std::shared_ptr<const lumen::LumenModel> model =
      session::CaseFile::open(found_case(), session::OpenMode::read_only).model();
  const imaging::ImageVolume& image = bench::full_image();
  analysis::SurfaceOfVessel surfaces = session::solved_surfaces(*model);
  session::CaseReport report = session::make_case_report(*model, surfaces, {}, {}, &image);
  std::vector<session::KeyImage> pictures = session::key_images(report, *model, surfaces, &image);
};

const Stages& stages() {
  static const Stages all;
  return all;
}

void walls_solved(benchmark::State& state) {
  const Stages& at = stages();
  for (auto _ : state) benchmark::DoNotOptimize(session::solved_surfaces(*at.model));
  state.counters["vessels"] = static_cast<double>(at.model->vessels.size());
}

void measured(benchmark::State& state) {
  const Stages& at = stages();
  for (auto _ : state)
    benchmark::DoNotOptimize(session::make_case_report(*at.model, at.surfaces, {}, {}, &at.image));
  state.counters["lesions"] = static_cast<double>(at.report.stenoses.size());
}

void pictured(benchmark::State& state) {
  const Stages& at = stages();
  for (auto _ : state)
    benchmark::DoNotOptimize(session::key_images(at.report, *at.model, at.surfaces, &at.image));
  state.counters["pictures"] = static_cast<double>(at.pictures.size());
}

void written(benchmark::State& state) {
  const Stages& at = stages();
  for (auto _ : state) {
    state.PauseTiming();
    // Pictures know their PNG once it was made.
    const std::vector<session::KeyImage> anew =
        session::key_images(at.report, *at.model, at.surfaces, &at.image);
    const std::filesystem::path folder = next_folder();
    state.ResumeTiming();
    session::write_case_report(folder, at.report, anew, {"report", {}, "{}"});
  }
}

void add(const char* name, void (*stage)(benchmark::State&)) {
  benchmark::RegisterBenchmark(name, stage)
      ->Unit(benchmark::kSecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime()
      ->Iterations(3);
}
[[maybe_unused]] const bool added = [] {
  add("Report: walls solved", walls_solved);
  add("Report: measured and judged", measured);
  add("Report: key images", pictured);
  add("Report: written", written);
  return true;
}();

}  // namespace
