#include "ostia/cohort/cohort_comparison.h"

#include "comparison_page.h"
#include "shown_measures.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/manifest.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <tuple>
#include <unordered_map>

namespace ostia::cohort {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t import_stage = stage_of("import"), most_shown = 10;
constexpr double amount_of_a_lost_result = 1e9;  // worse than any other figure

struct EarlierScan {
  std::string pseudonym;
  Outcome outcome;
  std::array<StageState, stages.size()> states{};
  bool ambiguous = false, met = false;
};
using EarlierScans = std::unordered_map<std::string, EarlierScan>;  ///< by digests of what was imported

std::array<StageState, stages.size()> states_of(const CohortScan& scan) {
  std::array<StageState, stages.size()> out{};
  std::ranges::transform(scan.results, out.begin(), &StageResult::state);
  return out;
}

/// Empty: it was not imported.
std::string content_of(const CohortScan& scan) {
  const StageResult& import = scan.results[import_stage];
  return is_done(import.state) ? scan.kind + " " + import.inputs : "";
}

std::string shown_number(double value) {
  return std::isfinite(value) ? core::significant_text(value, 6) : "";
}

/// Mean and spread as they come (Welford 1962).
struct Spread {
  std::size_t count = 0;
  double mean = 0.0, squares = 0.0;
  void take(double value) {
    ++count;
    const double off = value - mean;
    mean += off / static_cast<double>(count);
    squares += off * (value - mean);
  }
  double sd() const { return count < 2 ? 0.0 : std::sqrt(squares / static_cast<double>(count - 1)); }
};

class Comparing {
 public:
  Comparing(EarlierScans& earlier, const fs::path& csv) : earlier_(earlier), csv_(csv, std::ios::binary) {
    for (const ShownMeasure& one : shown_measures) out_.measures.push_back({one.name, one.unit});
    csv_ << core::csv_line({"scan", "before_scan", "what", "before", "after", "difference"});
  }
  void take(const CohortScan& scan, const Outcome& outcome);
  CohortComparison result();
  std::vector<ChangedScan>& most() { return most_; }

 private:
  void take_measures(ChangedScan& scan, const Outcome& before, const Outcome& after);
  void take_states(ChangedScan& scan, const EarlierScan& before, const CohortScan& after);
  void add(ChangedScan& scan, const std::string& what, const std::string& before, const std::string& after,
           double difference, double amount);

  EarlierScans& earlier_;
  std::ofstream csv_;
  CohortComparison out_;
  std::array<Spread, shown_measures.size()> spreads_;
  std::map<std::tuple<std::size_t, StageState, StageState>, std::size_t> states_;
  std::vector<ChangedScan> most_;  ///< the greatest amount first
};

void Comparing::add(ChangedScan& scan, const std::string& what, const std::string& before,
                    const std::string& after, double difference, double amount) {
  csv_ << core::csv_line({scan.after, scan.before, what, before, after, shown_number(difference)});
  scan.values.push_back({what, before, after});
  scan.amount = std::max(scan.amount, amount);
}

void Comparing::take_measures(ChangedScan& scan, const Outcome& before, const Outcome& after) {
  for (std::size_t i = 0; i < shown_measures.size(); ++i) {
    const ShownMeasure& measure = shown_measures[i];
    MeasureAgreement& one = out_.measures[i];
    const double a = before.*measure.value, b = after.*measure.value;
    if (std::isnan(a) && std::isnan(b)) continue;
    const double difference = b - a;
    if (std::isnan(difference)) {
      ++(std::isnan(b) ? one.lost : one.gained);
      add(scan, measure.name, shown_number(a), shown_number(b), difference, amount_of_a_lost_result);
      continue;
    }
    spreads_[i].take(difference);
    if (std::abs(difference) > std::abs(one.greatest)) one.greatest = difference;
    if (difference == 0.0) continue;
    ++one.changed;
    add(scan, measure.name, shown_number(a), shown_number(b), difference,
        std::abs(difference) / measure.step);
  }
  if (before.cad_rads != after.cad_rads)
    add(scan, "cad_rads", before.cad_rads, after.cad_rads, std::numeric_limits<double>::quiet_NaN(), 1.0);
}

void Comparing::take_states(ChangedScan& scan, const EarlierScan& before, const CohortScan& after) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageState a = before.states[i], b = after.results[i].state;
    if (a == b) continue;
    ++states_[{i, a, b}];
    add(scan, std::string("state of ") + stages[i].name, name_of(a), name_of(b),
        std::numeric_limits<double>::quiet_NaN(), is_done(a) != is_done(b) ? amount_of_a_lost_result : 1.0);
  }
}

void Comparing::take(const CohortScan& scan, const Outcome& outcome) {
  ++out_.after;
  const std::string content = content_of(scan);
  const auto found = content.empty() ? earlier_.end() : earlier_.find(content);
  if (found == earlier_.end()) return;
  EarlierScan& before = found->second;
  if (before.ambiguous || before.met) {
    ++out_.ambiguous;
    return;
  }
  before.met = true;
  ++out_.matched;
  ChangedScan changed;
  changed.before = before.pseudonym;
  changed.after = scan.pseudonym;
  take_measures(changed, before.outcome, outcome);
  take_states(changed, before, scan);
  if (changed.values.empty()) return;
  ++out_.changed;
  const auto place =
      std::ranges::upper_bound(most_, changed.amount, std::ranges::greater{}, &ChangedScan::amount);
  most_.insert(place, std::move(changed));
  if (most_.size() > most_shown) most_.pop_back();
}

CohortComparison Comparing::result() {
  for (std::size_t i = 0; i < shown_measures.size(); ++i) {
    MeasureAgreement& one = out_.measures[i];
    one.scans = spreads_[i].count;
    one.bias = spreads_[i].mean;
    one.sd = spreads_[i].sd();
    one.lower_limit = one.bias - 1.96 * one.sd;
    one.upper_limit = one.bias + 1.96 * one.sd;
  }
  for (const auto& [key, scans] : states_) {
    const auto& [stage, before, after] = key;
    out_.states.push_back({stages[stage].name, name_of(before), name_of(after), scans});
  }
  csv_.close();
  if (!csv_) throw ResourceError("cannot write the comparison: the disk is full, or out of order");
  return out_;
}

EarlierScans read_earlier(const OpenCohort& cohort, std::size_t& scans, const core::TaskContext& task) {
  EarlierScans out;
  Outcomes outcomes(cohort);
  cohort.for_each({}, task, [&](const CohortScan& scan) {
    ++scans;
    const std::string content = content_of(scan);
    if (content.empty()) return;
    const auto [at, is_new] = out.try_emplace(content);
    if (is_new)
      at->second = {scan.pseudonym, outcomes.of(scan), states_of(scan)};
    else
      at->second.ambiguous = true;
  });
  return out;
}

/// Its name in `folder`; empty where the scan has none.
std::string copied_picture(const fs::path& cohort, const std::string& scan, const fs::path& folder,
                           const std::string& name) {
  const fs::path source = cohort / "measures" / scan / "report/images/tree.png";
  std::error_code error;
  return fs::copy_file(source, folder / name, error) ? name : "";
}

}  // namespace

CohortComparison compare_cohorts(const fs::path& before, const fs::path& after, const fs::path& output,
                                 const core::TaskContext& task) {
  const auto start = std::chrono::steady_clock::now();
  const OpenCohort earlier(before), later(after);
  if (fs::equivalent(before, after))
    throw InvalidInput("cannot compare " + before.string() + " with itself; name two cohorts");
  pipeline::require_free_folder(output);
  core::StagedFolder staged(output);
  std::size_t count = 0;
  EarlierScans scans = read_earlier(earlier, count, task.sub(0.0, 0.5));
  Comparing comparing(scans, staged.temporary() / "changes.csv");
  Outcomes outcomes(later);
  later.for_each({}, task.sub(0.5, 1.0),
                 [&](const CohortScan& scan) { comparing.take(scan, outcomes.of(scan)); });
  CohortComparison out = comparing.result();
  out.before = count;
  std::size_t number = 0;
  for (ChangedScan& one : comparing.most()) {
    const std::string name = std::to_string(++number);
    one.pictures = {copied_picture(before, one.before, staged.temporary(), name + "-before.png"),
                    copied_picture(after, one.after, staged.temporary(), name + "-after.png")};
  }
  core::write_file(staged.temporary() / "index.html", comparison_page(out, comparing.most()));
  pipeline::ManifestRecord record;
  record.key = {"cohort compare", {{"changes", core::sha256_file(staged.temporary() / "changes.csv")}}, "{}"};
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pipeline::write_manifest(staged.temporary(), record);
  staged.commit();
  return out;
}

}  // namespace ostia::cohort
