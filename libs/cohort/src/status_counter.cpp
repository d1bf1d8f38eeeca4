#include "status_counter.h"

#include <algorithm>

namespace ostia::cohort {
namespace {

constexpr std::size_t most_kinds_of_failure = 4000;

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

void count_review(ReviewCounts& counts, const CohortScan& scan) {
  if (!is_done(scan.results[reviewed_stage].state)) return;
  if (!scan.review)
    ++counts.open;
  else
    ++(scan.review->verdict == Verdict::ok ? counts.ok : counts.again);
}

}  // namespace

std::size_t Reasons::take(const Stage& stage, const StageResult& result, const std::string& pseudonym) {
  std::tuple<std::string, int, std::string> key{stage.name, result.exit_code, without_numbers(result.reason)};
  if (known_.size() >= most_kinds_of_failure && known_.count(key) == 0)
    key = {stage.name, result.exit_code, "other reasons"};
  const auto [at, is_new] = known_.try_emplace(key, all_.size());
  if (is_new) all_.push_back({stage.name, result.exit_code, std::get<2>(key), 0, pseudonym});
  ++all_[at->second].scans;
  return at->second;
}

StatusCounter::StatusCounter(std::size_t refused) {
  status_.refused = refused;
  for (const Stage& stage : stages) status_.stages.push_back({stage.name, {}, 0.0, 0.0});
}

std::vector<std::size_t> StatusCounter::take(const CohortScan& scan) {
  std::vector<std::size_t> failures;
  ++status_.scans;
  status_.whole += std::ranges::all_of(scan.results, [](const StageResult& r) { return is_done(r.state); });
  count_review(status_.review, scan);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageResult& one = scan.results[i];
    StageCounts& counts = status_.stages[i];
    ++counts.scans[static_cast<std::size_t>(one.state)];
    if (one.state == StageState::failed) failures.push_back(reasons_.take(stages[i], one, scan.pseudonym));
    if (!is_done(one.state)) continue;
    counts.seconds += one.seconds;
    counts.peak_mb = std::max(counts.peak_mb, one.peak_mb);
  }
  return failures;
}

CohortStatus StatusCounter::result() const {
  CohortStatus out = status_;
  out.reasons = reasons_.all();
  std::ranges::stable_sort(out.reasons, [](const FailureReason& a, const FailureReason& b) {
    return std::tie(b.scans, a.stage, a.exit_code, a.reason) <
           std::tie(a.scans, b.stage, b.exit_code, b.reason);
  });
  return out;
}

}  // namespace ostia::cohort
