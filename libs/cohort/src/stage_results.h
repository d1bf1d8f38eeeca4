#pragma once
/// \file What is known of every stage of every scan.

#include "store.h"

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/status.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace ostia::cohort {

struct StageResult {
  StageState state = StageState::waiting;
  int exit_code = 0;
  double seconds = 0.0, peak_mb = 0.0;
  std::string reason;
  std::string inputs;  ///< digests of what it was made of, each followed by a space
  std::string result;  ///< digest of the stage's result
  std::string stamp;   ///< of the file that says so: another one where it was written anew
};

struct CohortScan {
  std::int64_t number = 0;
  std::string pseudonym, patient, kind;
  std::array<StageResult, stages.size()> results;
};

/// A cohort's database, checked to be one. Throws InvalidInput, IoError.
class OpenCohort {
 public:
  explicit OpenCohort(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }
  const Store& store() const { return store_; }
  std::size_t count(const char* table) const;
  /// All scans in their order. Results that are known already are not read again; others are stored.
  void for_each(const StatusOptions& options, const core::TaskContext& task,
                const std::function<void(const CohortScan&)>& take) const;

 private:
  std::vector<CohortScan> scans_from(std::int64_t number) const;

  std::filesystem::path folder_;
  Store store_;
};

}  // namespace ostia::cohort
