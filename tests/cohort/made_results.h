#pragma once
/// \file A cohort, and results in it as `ostia run` and the workflow leave them.

#include "shared_data.h"
#include "store.h"

#include "ostia/cohort/cohort.h"
#include "ostia/core/files.h"
#include "ostia/pipeline/manifest.h"

#include <string>
#include <vector>

namespace ostia::cohort {

class MadeCohort {
 public:
  MadeCohort(const std::string& name, int scans) : folder_(ostia::testing::temporary_folder(name)) {
    std::string table = "id,scan,kind\n";
    for (int i = 0; i < scans; ++i) {
      const std::string file = "scan" + std::to_string(i) + ".nrrd";
      core::write_file(folder_ / file, "x");
      table += "p" + std::to_string(i) + "," + file + ",mask\n";
    }
    core::write_file(folder_ / "table.csv", table);
    init_cohort({folder_ / "table.csv", folder(), false});
    const Store store(folder() / database_name, Store::Mode::read);
    Query rows(store, "SELECT pseudonym FROM scan ORDER BY number");
    while (rows.step()) scans_.push_back(rows.text(0));
  }
  std::filesystem::path folder() const { return folder_ / "study"; }
  std::filesystem::path beside(const std::string& name) const { return folder_ / name; }
  const std::string& scan(std::size_t number) const { return scans_[number]; }
  std::filesystem::path at(std::size_t scan, std::size_t stage) const {
    return folder() / stages[stage].folder / scans_[scan];
  }

  /// A finished stage whose result has this content, made of the result that the stage before it has now.
  void make(std::size_t scan, std::size_t stage, const std::string& content,
            ExitCode code = ExitCode::ok) const {
    const std::filesystem::path folder = at(scan, stage);
    std::filesystem::remove_all(folder);
    core::write_file(folder / stages[stage].result, content);
    pipeline::ManifestRecord record;
    record.key = {"run", {{"input 1", source_of(scan, stage)}}, "{}"};
    record.exit_code = code;
    record.seconds = 2.0;
    pipeline::write_manifest(folder, record);
  }
  void make_all(std::size_t scan, const std::string& report,
                const std::string& pressure = made_pressure) const {
    for (std::size_t i = 0; i < stages.size(); ++i)
      make(scan, i,
           i == stage_of("measures")   ? report
           : i == stage_of("pressure") ? pressure
                                       : stages[i].name);
  }
  static constexpr const char* made_pressure = R"({"v":1,"kind":"ffr","outlets":[]})";
  /// The workflow's record of a stage that ended without a result.
  void record(std::size_t scan, std::size_t stage, const std::string& code, const std::string& signal,
              const std::string& message) const {
    core::write_file(folder() / "logs" / scans_[scan] / (std::string(stages[stage].name) + ".json"),
                     R"({"v":1,"kind":"cohort step","exit_code":)" + code + R"(,"signal":)" + signal +
                         R"(,"seconds":1.5,"message":")" + message + "\"}");
  }

 private:
  std::string source_of(std::size_t scan, std::size_t stage) const {
    if (stages[stage].after < 0) return core::sha256("x");
    const auto before = static_cast<std::size_t>(stages[stage].after);
    return core::sha256_file(at(scan, before) / stages[before].result);
  }
  std::filesystem::path folder_;
  std::vector<std::string> scans_;
};

}  // namespace ostia::cohort
