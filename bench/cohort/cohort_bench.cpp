// A cohort of a million rows: begun, looked over, and its page made. One scan in a hundred has results, one
// in a hundred failed; the others wait. Each figure is processor time of the whole process, of all threads
// and in the system, too.

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/page.h"
#include "ostia/cohort/pseudonym.h"
#include "ostia/cohort/status.h"
#include "ostia/core/files.h"
#include "ostia/core/private_folder.h"
#include "ostia/pipeline/manifest.h"

#include <benchmark/benchmark.h>

#include <fstream>
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

/// As the workflow leaves it; not synced, since what is measured is not the disk.
void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

void finish(const std::filesystem::path& study, const std::string& scan, std::int64_t number) {
  const std::string of_number = std::to_string(1 + number % 12);
  for (const cohort::Stage& stage : cohort::stages) {
    const std::string name = stage.name;
    const std::string content =
        name == "measures"
            ? R"({"v":1,"kind":"case report","cad_rads":{"category":"2"},"segments":[{"least_area_mm2":)" +
                  of_number + R"(}],"stenoses":[{"diameter_percent":)" + of_number + "}]}"
        : name == "pressure" ? R"({"v":1,"kind":"ffr","outlets":[{"ffr":0.)" + of_number + "}]}"
                             : name + scan;
    const auto before = stage.after < 0 ? std::string("x")
                                        : cohort::stages[static_cast<std::size_t>(stage.after)].name + scan;
    const std::filesystem::path folder = study / stage.folder / scan;
    put(folder / stage.result, content);
    put(folder / "manifest.json",
        R"({"v":1,"command":"run","exit_code":0,"seconds":1,"peak_mb":1,"inputs":{"input 1":")" +
            core::sha256(before) + R"("},"outputs":{")" + stage.result + R"(":")" + core::sha256(content) +
            R"("}})");
  }
}

void simulate(const std::filesystem::path& study, std::int64_t rows) {
  const cohort::Pseudonyms names(core::read_file(cohort::private_folder_of(study) / "key").substr(0, 64));
  for (std::int64_t i = 0; i < rows; i += 50) {
    const std::string scan = names.of("scan patient " + std::to_string(i));
    if (i % 100 == 0)
      finish(study, scan, i);
    else
      put(study / "logs" / scan / "import.json",
          R"({"v":1,"kind":"cohort step","exit_code":3,"signal":null,"seconds":1,"message":"slice )" +
              std::to_string(i) + R"( is missing"})");
  }
}

void init(benchmark::State& state) {
  const ManyRows rows(state.range(0));
  for (auto _ : state) {
    cohort::init_cohort(rows.options());
    state.PauseTiming();
    rows.clear();
    state.ResumeTiming();
  }
}

/// What all that follow look at, made once.
const ManyRows& simulated_rows(std::int64_t rows) {
  static const ManyRows* made = [rows] {
    static const ManyRows all(rows);
    cohort::init_cohort(all.options());
    simulate(all.study(), rows);
    return &all;
  }();
  return *made;
}

void status_at_first(benchmark::State& state) {
  const ManyRows& rows = simulated_rows(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cohort::read_status(rows.study()).scans);
}

void status_again(benchmark::State& state) {
  const ManyRows& rows = simulated_rows(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cohort::read_status(rows.study()).scans);
}

void page(benchmark::State& state) {
  const ManyRows& rows = simulated_rows(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(cohort::write_page(rows.study()).scans);
  state.counters["peak_MB"] = pipeline::peak_memory_mb();
}

void once(benchmark::internal::Benchmark* one) {
  one->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();
}
BENCHMARK(init)->Apply(once);
BENCHMARK(status_at_first)->Apply(once);
BENCHMARK(status_again)->Apply(once);
BENCHMARK(page)->Apply(once);

}  // namespace

BENCHMARK_MAIN();
