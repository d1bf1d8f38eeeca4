// A cohort of a million rows: begun, and looked over before and after anything is known of its scans.

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/status.h"
#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace ostia;

/// Rows of one small folder, told apart by their series: what is measured is not the disk.
class ManyRows {
 public:
  explicit ManyRows(std::int64_t rows) {
    core::write_file(folder_.path() / "CT/slice.dcm", "x");
    std::string table = "id,scan,series\n";
    for (std::int64_t i = 0; i < rows; ++i)
      table += "patient " + std::to_string(i) + ",CT,1.2." + std::to_string(i) + "\n";
    core::write_file(folder_.path() / "scans.csv", table);
  }
  cohort::InitOptions options() const { return {folder_.path() / "scans.csv", study(), false}; }
  std::filesystem::path study() const { return folder_.path() / "study"; }
  void clear() const {
    std::filesystem::remove_all(study());
    std::filesystem::remove_all(cohort::private_folder_of(study()));
  }

 private:
  core::PrivateFolder folder_;
};

void init(benchmark::State& state) {
  const ManyRows rows(state.range(0));
  for (auto _ : state) {
    cohort::init_cohort(rows.options());
    state.PauseTiming();
    rows.clear();
    state.ResumeTiming();
  }
}
BENCHMARK(init)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

void status(benchmark::State& state) {
  const ManyRows rows(state.range(0));
  cohort::init_cohort(rows.options());
  for (auto _ : state) benchmark::DoNotOptimize(cohort::read_status(rows.study()).scans);
}
BENCHMARK(status)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
