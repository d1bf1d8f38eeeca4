#pragma once
/// \file The table of a batch's cases, `results.csv`.

#include "ostia/core/error.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::app {

struct CaseOutcome {
  std::string name;
  std::string status;  ///< "ok", "quality" (a person must look), "failed"
  int exit_code = 0;
  double seconds = 0.0, peak_mb = 0.0;
  std::string message;
};

/// "ok", "quality" or "failed".
std::string status_of(int exit_code);

/// One line a case, in the order of the batch's own table, then what is known of other cases from earlier
/// runs in the same folder. Kept on disk.
class BatchResults {
 public:
  /// Takes over what `file` has; one that cannot be read is replaced.
  BatchResults(std::filesystem::path file, const std::vector<std::string>& cases);
  /// Takes the place of what was known of the case, and writes the file.
  void keep(const CaseOutcome& outcome);

 private:
  std::filesystem::path file_;
  std::vector<CaseOutcome> outcomes_;  ///< without status: not known yet
};

/// What the manifest in a case's folder has of it: exit code, time and peak memory of all its steps,
/// whichever run did them, and the reasons why a person must look. Nothing changed (but for the status) where
/// there is no manifest that can be read.
void take_from_manifest(const std::filesystem::path& folder, CaseOutcome& outcome);

/// The last error of a log in JSON, which holds no path; empty: none.
std::string last_error(const std::string& log);

}  // namespace ostia::app
