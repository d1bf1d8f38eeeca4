#include "ostia/cohort/status.h"

#include "stage_results.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_kinds_of_failure = 10000;

/// Messages that differ in their numbers alone are one reason.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
    if (!digit(i)) {
      out += text[i++];
      continue;
    }
    out += '#';
    while (digit(i) || (i < text.size() && text[i] == '.' && digit(i + 1))) ++i;
  }
  return out;
}

/// Counts them as they come; in the end the most frequent stand first.
class Reasons {
 public:
  void take(const Stage& stage, const StageResult& result, const std::string& pseudonym) {
    std::string reason = without_numbers(result.reason);
    Key key{stage.name, result.exit_code, reason};
    if (known_.size() >= most_kinds_of_failure && known_.count(key) == 0)
      key = {stage.name, result.exit_code, reason = "other reasons"};
    FailureReason& one =
        known_.try_emplace(key, FailureReason{stage.name, result.exit_code, reason, 0, pseudonym})
            .first->second;
    ++one.scans;
  }
  std::vector<FailureReason> sorted() const {
    std::vector<FailureReason> all;
    for (const auto& [key, one] : known_) all.push_back(one);
    std::ranges::stable_sort(all, std::ranges::greater{}, &FailureReason::scans);
    return all;
  }

 private:
  using Key = std::tuple<std::string, int, std::string>;
  std::map<Key, FailureReason> known_;
};

}  // namespace

std::string name_of(StageState state) {
  switch (state) {
    case StageState::ok:
      return "ok";
    case StageState::quality:
      return "quality";
    case StageState::failed:
      return "failed";
    case StageState::stale:
      return "stale";
    case StageState::damaged:
      return "damaged";
    case StageState::waiting:
      break;
  }
  return "waiting";
}

CohortStatus read_status(const fs::path& folder, const StatusOptions& options,
                         const core::TaskContext& task) {
  const OpenCohort cohort(folder);
  CohortStatus out;
  out.refused = cohort.count("refused");
  for (const Stage& stage : stages) out.stages.push_back({stage.name, {}, 0.0, 0.0});
  Reasons reasons;
  cohort.for_each(options, task, [&](const CohortScan& scan) {
    ++out.scans;
    out.whole += std::ranges::all_of(scan.results, [](const StageResult& r) { return is_done(r.state); });
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const StageResult& one = scan.results[i];
      StageCounts& counts = out.stages[i];
      ++counts.scans[static_cast<std::size_t>(one.state)];
      if (one.state == StageState::failed) reasons.take(stages[i], one, scan.pseudonym);
      if (!is_done(one.state)) continue;
      counts.seconds += one.seconds;
      counts.peak_mb = std::max(counts.peak_mb, one.peak_mb);
    }
  });
  out.reasons = reasons.sorted();
  return out;
}

}  // namespace ostia::cohort
