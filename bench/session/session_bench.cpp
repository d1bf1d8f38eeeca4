// An edit committed to the case file. Run it in a folder on the disk that cases lie on; the sync of that disk
// alone is measured beside it.

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace ostia {
namespace {

namespace fs = std::filesystem;

/// Five vessels, about 4,000 samples.
const lumen::LumenModel& tree() {
  static const lumen::LumenModel model = [] {
    lumen::SamplingOptions sampling;
    sampling.spacing_mm = 0.7;
    return lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree()), {}, sampling);
  }();
  return model;
}

std::size_t sample_count(const lumen::LumenModel& model) {
  std::size_t count = 0;
  for (const auto& vessel : model.vessels) count += vessel->samples.size();
  return count;
}

/// A contour of 12 points across a vessel; it takes the place of about as many samples.
lumen::SectionContour contour(const lumen::LumenModel& model, int i) {
  const lumen::VesselLumen& vessel = *model.vessels[static_cast<std::size_t>(i) % model.vessels.size()];
  const double from = vessel.own_from_mm + 6.0, to = vessel.axis->length() - 3.0;
  lumen::SectionContour edit;
  edit.vessel = vessel.vessel;
  edit.s_mm = from + std::fmod(1.7 * i, std::max(0.5, to - from));
  edit.eps_mm = 0.7;
  const double radius = vessel.axis->radius(edit.s_mm) * (1.0 + 0.02 * (i % 3));
  for (int k = 0; k < 12; ++k)
    edit.points.push_back(vessel.axis->place(edit.s_mm, 2.0 * std::numbers::pi * k / 12.0, radius));
  return edit;
}

double ms(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double, std::milli>(d).count();
}
double cpu_ms() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}
double p95(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[(values.size() * 95) / 100];
}

/// The wall clock from the computed outcome to the return of `apply`: rows, changeset, journal, sync.
void EditCommitted(benchmark::State& state, const fs::path& folder) {
  const fs::path path = folder / ("ostia-bench-" + std::to_string(::getpid()) + ".ostia");
  std::vector<double> wall, cpu;
  double changed = 0.0;
  {
    session::CaseFile file = session::CaseFile::create(path, tree());
    int i = 0;
    for (auto _ : state) {
      std::chrono::steady_clock::time_point start;
      double cpu_start = 0.0;
      const lumen::EditOutcome outcome = file.apply(contour(*file.model(), i++), [&](const auto&) {
        cpu_start = cpu_ms();
        start = std::chrono::steady_clock::now();
      });
      wall.push_back(ms(std::chrono::steady_clock::now() - start));
      cpu.push_back(cpu_ms() - cpu_start);
      state.SetIterationTime(wall.back() * 1e-3);
      for (const auto& change : outcome.changes)
        changed += static_cast<double>(change.added.size() + change.removed.size());
    }
  }
  state.counters["p95_ms"] = p95(wall);
  state.counters["cpu_p95_ms"] = p95(cpu);
  state.counters["rows_an_edit"] = changed / static_cast<double>(std::max<std::size_t>(1, wall.size()));
  state.counters["samples"] = static_cast<double>(sample_count(tree()));
  fs::remove(path);
}
BENCHMARK_CAPTURE(EditCommitted, on_disk, fs::path("."))
    ->UseManualTime()
    ->Iterations(300)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(EditCommitted, in_memory_file_system, fs::path("/dev/shm"))
    ->UseManualTime()
    ->Iterations(300)
    ->Unit(benchmark::kMillisecond);

/// What the disk takes to make as many bytes durable, without a database.
void SyncOfTheDiskAlone(benchmark::State& state) {
  const std::string name = "ostia-bench-sync-" + std::to_string(::getpid());
  const int file = ::open(name.c_str(), O_CREAT | O_RDWR | O_TRUNC | O_CLOEXEC, 0600);
  const std::string bytes(40000, 'x');
  std::vector<double> wall;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    if (::write(file, bytes.data(), bytes.size()) < 0 || ::fdatasync(file) != 0)
      state.SkipWithError("cannot write");
    wall.push_back(ms(std::chrono::steady_clock::now() - start));
    state.SetIterationTime(wall.back() * 1e-3);
  }
  ::close(file);
  ::unlink(name.c_str());
  state.counters["p95_ms"] = p95(wall);
}
BENCHMARK(SyncOfTheDiskAlone)->UseManualTime()->Iterations(300)->Unit(benchmark::kMillisecond);

/// A step taken back: the inverse changeset, and the touched vessel read again.
void UndoAndRedo(benchmark::State& state) {
  const std::string path = "ostia-bench-undo-" + std::to_string(::getpid()) + ".ostia";
  {
    session::CaseFile file = session::CaseFile::create(path, tree());
    file.apply(contour(*file.model(), 0));
    for (auto _ : state) {
      file.undo();
      file.redo();
    }
  }
  fs::remove(path);
}
BENCHMARK(UndoAndRedo)->Iterations(50)->UseRealTime()->Unit(benchmark::kMillisecond);

void OpenCase(benchmark::State& state) {
  const std::string path = "ostia-bench-open-" + std::to_string(::getpid()) + ".ostia";
  { session::CaseFile::create(path, tree()); }
  for (auto _ : state) benchmark::DoNotOptimize(session::CaseFile::open(path).model());
  fs::remove(path);
}
BENCHMARK(OpenCase)->Iterations(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ostia

BENCHMARK_MAIN();
