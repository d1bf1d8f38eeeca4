#pragma once
/// \file What is told of a whole cohort, counted scan by scan.

#include "stage_results.h"

#include "ostia/cohort/status.h"

#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace ostia::cohort {

/// Why stages failed. Messages that differ in their numbers alone are one reason.
class Reasons {
 public:
  /// Which of `all` it is. Beyond a few thousand different ones there is one for all others.
  std::size_t take(const Stage& stage, const StageResult& result, const std::string& pseudonym);
  const std::vector<FailureReason>& all() const { return all_; }  ///< in the order in which they were met

 private:
  std::map<std::tuple<std::string, int, std::string>, std::size_t> known_;
  std::vector<FailureReason> all_;
};

class StatusCounter {
 public:
  explicit StatusCounter(std::size_t refused);
  /// Reasons of this scan's failures, as indices of `reasons`.
  std::vector<std::size_t> take(const CohortScan& scan);
  CohortStatus result() const;
  const std::vector<FailureReason>& reasons() const { return reasons_.all(); }

 private:
  CohortStatus status_;
  Reasons reasons_;
};

}  // namespace ostia::cohort
