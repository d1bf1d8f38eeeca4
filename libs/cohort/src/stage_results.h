#pragma once
/// \file What is known of every stage of every scan.

#include "store.h"

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/review.h"
#include "ostia/cohort/status.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ostia::cohort {

/// Tables that a cohort may be without: one that is read only, and was begun before they were there.
inline constexpr const char* later_tables = R"(
CREATE TABLE IF NOT EXISTS review(number INTEGER PRIMARY KEY, scan INTEGER NOT NULL, verdict TEXT NOT NULL,
  reader TEXT NOT NULL, time TEXT NOT NULL, made TEXT NOT NULL, result TEXT NOT NULL);
CREATE INDEX IF NOT EXISTS review_scan ON review(scan);
CREATE TABLE IF NOT EXISTS outcome(scan INTEGER PRIMARY KEY, measures TEXT NOT NULL, pressure TEXT NOT NULL,
  cad_rads TEXT NOT NULL, mla_mm2 REAL, stenosis_percent REAL, plaque_mm3 REAL, ffr REAL);
)";

struct StageResult {
  StageState state = StageState::waiting;
  int exit_code = 0;
  double seconds = 0.0, peak_mb = 0.0;
  std::string reason;
  std::string inputs;  ///< digests of what it was made of, each followed by a space
  std::string result;  ///< digest of the stage's result
  std::string stamp;   ///< of the file that says so: another one where it was written anew
};

/// What a person said last of the case that is there now.
struct KnownReview {
  Verdict verdict = Verdict::ok;
  std::string reader, time;
  std::string made;    ///< digest that the case had when it was made
  std::string result;  ///< its digest when it was reviewed: a person may have corrected it
};

struct CohortScan {
  std::int64_t number = 0;  ///< from 1, without gaps
  std::string pseudonym, patient, kind;
  std::array<StageResult, stages.size()> results{};
  std::optional<KnownReview> review{};
};

/// A cohort's database, checked to be one. Throws InvalidInput, IoError.
class OpenCohort {
 public:
  explicit OpenCohort(const std::filesystem::path& folder);
  const std::filesystem::path& folder() const { return folder_; }
  const Store& store() const { return store_; }
  std::size_t count(const char* table) const;
  bool has_later_tables() const { return has_later_tables_; }
  bool keeps() const { return keeps_; }  ///< `for_each` may write now
  /// The number of a scan; 0: it has none of this name.
  std::int64_t number_of(const std::string& pseudonym) const;
  /// What lies there now, read anew; without what follows from other stages.
  StageResult result_of(const std::string& pseudonym, std::size_t stage) const;
  std::string table_digest() const;
  /// All scans in their order. Results that are known already are not read again; others are stored.
  void for_each(const StatusOptions& options, const core::TaskContext& task,
                const std::function<void(const CohortScan&)>& take) const;

 private:
  std::vector<CohortScan> scans_from(std::int64_t number) const;
  void add_reviews(std::vector<CohortScan>& scans) const;

  std::filesystem::path folder_;
  Store store_;
  bool has_later_tables_ = false;
  mutable bool keeps_ = false;
};

}  // namespace ostia::cohort
