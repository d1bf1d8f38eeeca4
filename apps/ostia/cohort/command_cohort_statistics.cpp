// `ostia cohort statistics`: a cohort's measures against what else is known of its scans.

#include "cohort/cohort.h"
#include "output/told.h"

#include "ostia/cohort/statistics.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"

namespace ostia::app {
namespace {

ToldJson json_of_agreements(const cohort::Statistics& found) {
  ToldJson all = ToldJson::array();
  for (const cohort::MeasureInBoth& one : found.agreements)
    all.push_back({{"level", one.level},
                   {"measure", one.measure},
                   {"unit", one.unit},
                   {"pairs", one.agreement.count},
                   {"bias", one.agreement.bias},
                   {"sd", one.agreement.sd},
                   {"lower_limit", one.agreement.lower_limit},
                   {"upper_limit", one.agreement.upper_limit}});
  return all;
}

ToldJson json_of_outcomes(const cohort::Statistics& found) {
  ToldJson all = ToldJson::array();
  for (const cohort::MeasureOfOutcome& one : found.outcomes)
    all.push_back({{"outcome", one.outcome},
                   {"measure", one.measure},
                   {"unit", one.unit},
                   {"with", one.roc.positive},
                   {"without", one.roc.negative},
                   {"area", one.roc.area},
                   {"area_from", one.roc.area_interval[0]},
                   {"area_to", one.roc.area_interval[1]},
                   {"low_is_worse", one.low_is_worse},
                   {"threshold", one.low_is_worse ? -one.roc.best.threshold : one.roc.best.threshold},
                   {"sensitivity", one.roc.best.sensitivity},
                   {"specificity", one.roc.best.specificity}});
  return all;
}

std::string text_of_statistics(const cohort::Statistics& found) {
  const auto number = [](double value) { return core::significant_text(value, 4); };
  std::string text;
  for (const cohort::MeasureInBoth& one : found.agreements)
    text += one.level + ", " + one.measure + ": " + counted(one.agreement.count, "pair") + ", bias " +
            number(one.agreement.bias) + ", limits of agreement " + number(one.agreement.lower_limit) +
            " to " + number(one.agreement.upper_limit) +
            (one.unit.empty() || one.unit == "1" ? "" : " " + one.unit) + "\n";
  for (const cohort::MeasureOfOutcome& one : found.outcomes)
    text += one.outcome + " by " + one.measure + ": area " + core::fixed_text(one.roc.area, 3) + " of " +
            std::to_string(one.roc.positive) + " with and " + std::to_string(one.roc.negative) + " without\n";
  return text;
}

}  // namespace

ExitCode run_cohort_statistics(const CohortStatisticsCommand& c, const core::TaskContext& task) {
  const cohort::Statistics found = cohort::write_statistics({c.tables, c.reference, c.output}, task);
  if (found.unknown > 0)
    core::log_warning(counted(found.unknown, "scan") + " of the reference: not in the tables");
  tell("cohort statistics",
       {{"scans", found.scans},
        {"unknown", found.unknown},
        {"agreements", json_of_agreements(found)},
        {"outcomes", json_of_outcomes(found)}},
       text_of_statistics(found) + counted(found.scans, "scan") + " in both; index.html shows them", c.json);
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
