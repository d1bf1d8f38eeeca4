#pragma once
/// \file Where the scans of a cohort are, read off the manifests of what was made of them.

#include "ostia/cohort/cohort.h"
#include "ostia/core/task_context.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::cohort {

enum class StageState {
  waiting,  ///< not begun, or a stage before it is not done
  ok,
  quality,  ///< done, but a person must look (exit code 4)
  failed,   ///< ended without a result
  stale,    ///< made of another result than the one that is there now
  damaged,  ///< what its manifest names is not there, or (where digests are checked) another
};
inline constexpr std::size_t stage_state_count = 6;
std::string name_of(StageState state);
constexpr bool is_done(StageState state) {
  return state == StageState::ok || state == StageState::quality;
}

struct StageCounts {
  std::string stage;
  std::array<std::size_t, stage_state_count> scans{};  ///< by state
  double seconds = 0.0;                                ///< all that are done, together
  double peak_mb = 0.0;                                ///< the most of them
};

struct FailureReason {
  std::string stage;
  int exit_code = 0;   ///< 128 + n where signal n ended it
  std::string reason;  ///< its last message, numbers replaced by "#"
  std::size_t scans = 0;
  std::string example;  ///< pseudonym of one of them
};

/// Scans whose case is made, by what a person said of the case that is there now.
struct ReviewCounts {
  std::size_t ok = 0, again = 0, open = 0;
};

struct CohortStatus {
  std::size_t scans = 0;
  std::size_t refused = 0;  ///< rows of the table that were left out when the cohort was begun
  std::size_t whole = 0;    ///< scans whose stages are all done
  ReviewCounts review;
  std::vector<StageCounts> stages;
  std::vector<FailureReason> reasons;  ///< most frequent first
};

struct StatusOptions {
  bool verify = false;  ///< compute the digest of every file that a manifest names
};

/// A stage counts as done where its folder has a manifest of a finished run, what it names is there, and it
/// was made of the result before it that is there now. What was read before is kept in the database and not
/// read again unless it changed; where the database cannot be written all is read each time. Memory
/// grows by 8 bytes a result. Throws InvalidInput (no cohort, one of a newer version), IoError,
/// Cancelled.
CohortStatus read_status(const std::filesystem::path& cohort, const StatusOptions& options = {},
                         const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
