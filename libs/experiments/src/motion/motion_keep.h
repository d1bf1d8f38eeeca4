#pragma once
/// \file The motion experiment's runs as tables, and a folder that keeps them while it goes on.

#include "ostia/experiments/motion.h"

#include <span>

namespace ostia::experiments {

std::string runs_csv(std::span<const MotionRun> runs);          ///< with a header
std::string branches_csv(std::span<const BranchRun> branches);  ///< with a header

/// runs.csv, branches.csv and hearts.json (what the hearts are made of) in a folder that is made if it is not
/// there. Results are appended as they come, so that a run that is stopped loses the one that it is at.
class MotionKeep {
 public:
  /// Without a folder, all is in memory alone. Throws InvalidInput for runs of hearts made otherwise, or a
  /// table that cannot be read (file and line); IoError.
  explicit MotionKeep(const MotionOptions& options);
  const MotionResults& results() const { return results_; }
  /// How many runs there are of a heart by a method at a depth, with these phases known; of one phase unless
  /// it is negative.
  std::size_t count(const std::string& heart, MotionMethod method, int depth, const std::string& sampling,
                    double phase = -1.0) const;
  bool has_branches(const std::string& heart, int depth) const;
  /// What is there of the same kind, heart and phase is replaced. Throws IoError.
  void add(const std::vector<MotionRun>& runs, const std::vector<BranchRun>& branches = {});

 private:
  void put(const MotionRun& run);
  void put(const BranchRun& run);
  std::filesystem::path folder_;
  MotionResults results_;
};

}  // namespace ostia::experiments
