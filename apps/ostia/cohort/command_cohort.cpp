// `ostia cohort`: a folder for many scans, where they are, and their measures as tables.

#include "cohort/cohort.h"
#include "output/told.h"

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/cohort_comparison.h"
#include "ostia/cohort/measure_table.h"
#include "ostia/cohort/page.h"
#include "ostia/cohort/page_server.h"
#include "ostia/cohort/review.h"
#include "ostia/cohort/status.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cstdio>

namespace ostia::app {
namespace {

constexpr std::size_t most_reasons_shown = 20;

void say_unused_columns(const std::vector<std::string>& columns) {
  if (columns.empty()) return;
  std::string names;
  for (const std::string& one : columns) names += (names.empty() ? "" : ", ") + one;
  core::log_warning("columns that a cohort has no use for stay in the table alone: " + names);
}

ToldJson json_of_refused(const std::vector<cohort::RefusedRow>& rows) {
  ToldJson all = ToldJson::array();
  for (const cohort::RefusedRow& row : rows)
    all.push_back({{"line", row.line}, {"reason", row.reason}, {"text", row.text}});
  return all;
}

std::string text_of_refused(const std::vector<cohort::RefusedRow>& rows) {
  std::string text;
  for (const cohort::RefusedRow& row : rows)
    text += "line " + std::to_string(row.line) + ": " + row.text + "\n";
  return text;
}

std::string padded_cell(std::string text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string text_of_status(const cohort::CohortStatus& status) {
  constexpr std::size_t width = 10;
  std::string text =
      counted(status.scans, "scan") + ", " + std::to_string(status.whole) + " of them whole" +
      (status.refused > 0 ? "; rows left out of the table: " + std::to_string(status.refused) : "");
  text += "\n" + padded_cell("stage", width);
  for (std::size_t s = 0; s < cohort::stage_state_count; ++s)
    text += padded_cell(name_of(static_cast<cohort::StageState>(s)), width);
  for (const cohort::StageCounts& stage : status.stages) {
    text += "\n" + padded_cell(stage.stage, width);
    for (const std::size_t count : stage.scans) text += padded_cell(std::to_string(count), width);
  }
  text += "\nreviewed: " + std::to_string(status.review.ok) + " OK, " + std::to_string(status.review.again) +
          " to be looked at again, " + std::to_string(status.review.open) + " not yet";
  for (std::size_t i = 0; i < std::min(most_reasons_shown, status.reasons.size()); ++i) {
    const cohort::FailureReason& one = status.reasons[i];
    text += "\n" + one.stage + ", exit code " + std::to_string(one.exit_code) + ", " +
            counted(one.scans, "scan") + " (" + one.example + "): " + one.reason;
  }
  if (status.reasons.size() > most_reasons_shown)
    text += "\n... and " + counted(status.reasons.size() - most_reasons_shown, "reason") + " more (--json)";
  return text;
}

ToldJson json_of_status(const cohort::CohortStatus& status) {
  ToldJson stages = ToldJson::array(), reasons = ToldJson::array();
  for (const cohort::StageCounts& stage : status.stages) {
    ToldJson one{{"stage", stage.stage}};
    for (std::size_t s = 0; s < cohort::stage_state_count; ++s)
      one[name_of(static_cast<cohort::StageState>(s))] = stage.scans[s];
    one["seconds"] = stage.seconds;
    one["peak_mb"] = stage.peak_mb;
    stages.push_back(std::move(one));
  }
  for (const cohort::FailureReason& one : status.reasons)
    reasons.push_back({{"stage", one.stage},
                       {"exit_code", one.exit_code},
                       {"reason", one.reason},
                       {"scans", one.scans},
                       {"example", one.example}});
  return {
      {"scans", status.scans},
      {"refused", status.refused},
      {"whole", status.whole},
      {"review", {{"ok", status.review.ok}, {"again", status.review.again}, {"open", status.review.open}}},
      {"stages", std::move(stages)},
      {"reasons", std::move(reasons)}};
}

}  // namespace

ExitCode run_cohort_init(const CohortInitCommand& c, const core::TaskContext& task) {
  const cohort::InitResult result = cohort::init_cohort({c.table, c.output, c.skip_bad}, task);
  const auto& refused = result.check.refused;
  say_unused_columns(result.check.unused_columns);
  const std::string rows = std::to_string(refused.size()) + " of " + counted(result.check.rows, "row");
  const std::string line =
      result.made ? counted(result.scans, "scan") + "; the key and what pseudonyms stand for are in " +
                        result.private_folder.filename().string() + ", which is not to be shared"
                  : rows + " cannot be used; nothing was made. Mend them, or leave them out by --skip-bad";
  tell("cohort init",
       {{"rows", result.check.rows},
        {"scans", result.scans},
        {"made", result.made},
        {"refused", json_of_refused(refused)}},
       text_of_refused(refused) + line, c.json);
  task.set_progress(1.0);
  if (refused.empty()) return ExitCode::ok;
  return result.made ? ExitCode::quality_failed : ExitCode::bad_input;
}

ExitCode run_cohort_status(const CohortStatusCommand& c, const core::TaskContext& task) {
  const cohort::CohortStatus status = cohort::read_status(c.cohort, {c.verify}, task);
  tell("cohort status", json_of_status(status), text_of_status(status), c.json);
  return ExitCode::ok;
}

ExitCode run_cohort_table(const CohortTableCommand& c, const core::TaskContext& task) {
  const cohort::MeasureTableResult result = cohort::write_measure_table(c.cohort, c.output, task);
  tell("cohort table", {{"scans", result.scans}, {"measured", result.measured}, {"values", result.values}},
       std::to_string(result.measured) + " of " + counted(result.scans, "scan") + " measured, " +
           counted(result.values, "value") + "; dictionary.csv says what they are",
       c.json);
  task.set_progress(1.0);
  return ExitCode::ok;
}

ExitCode run_cohort_page(const CohortPageCommand& c, const core::TaskContext& task) {
  const cohort::PageResult result = cohort::write_page(c.cohort, task);
  tell("cohort page", {{"scans", result.scans}, {"files", result.files}, {"page", "page/index.html"}},
       counted(result.scans, "scan") + "; open " + result.page.string() + " in a browser", c.json);
  task.set_progress(1.0);
  return ExitCode::ok;
}

ExitCode run_cohort_serve(const CohortServeCommand& c, const core::TaskContext& task) {
  cohort::write_page(c.cohort, task);
  cohort::PageServer server(c.cohort, c.port);
  tell("cohort serve", {{"url", server.url()}},
       server.url() + "\nis for you alone: who knows it may write reviews. Ctrl+C ends it", c.json);
  std::fflush(stdout);  // who started it waits for the address
  task.set_progress(1.0);
  server.run(task);
  return ExitCode::ok;
}

ExitCode run_cohort_compare(const CohortCompareCommand& c, const core::TaskContext& task) {
  const cohort::CohortComparison found = cohort::compare_cohorts(c.before, c.after, c.output, task);
  ToldJson measures = ToldJson::array(), states = ToldJson::array();
  for (const cohort::MeasureAgreement& one : found.measures)
    measures.push_back({{"measure", one.measure},
                        {"unit", one.unit},
                        {"scans", one.scans},
                        {"changed", one.changed},
                        {"lost", one.lost},
                        {"gained", one.gained},
                        {"bias", one.bias},
                        {"sd", one.sd},
                        {"lower_limit", one.lower_limit},
                        {"upper_limit", one.upper_limit},
                        {"greatest", one.greatest}});
  for (const cohort::StateChange& one : found.states)
    states.push_back(
        {{"stage", one.stage}, {"before", one.before}, {"after", one.after}, {"scans", one.scans}});
  tell("cohort compare",
       {{"before", found.before},
        {"after", found.after},
        {"matched", found.matched},
        {"ambiguous", found.ambiguous},
        {"changed", found.changed},
        {"measures", std::move(measures)},
        {"states", std::move(states)}},
       std::to_string(found.changed) + " of " + counted(found.matched, "scan") +
           " changed that are in both; index.html shows those that changed most",
       c.json);
  task.set_progress(1.0);
  return ExitCode::ok;
}

ExitCode run_cohort_review(const CohortReviewCommand& c, const core::TaskContext& task) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;
  const auto reviews = cohort::parse_reviews(core::read_file(c.file, most_bytes), c.file.string());
  const cohort::TakenReviews taken = cohort::take_reviews(c.cohort, reviews, task);
  ToldJson left_out = ToldJson::array();
  std::string text;
  for (const std::string& scan : taken.left_out) {
    left_out.push_back(scan);
    text += scan + ": left out, its case is not there or was made anew since; look at it again\n";
  }
  tell("cohort review",
       {{"ok", taken.ok},
        {"again", taken.again},
        {"taken_back", taken.taken_back},
        {"left_out", std::move(left_out)}},
       text + std::to_string(taken.ok) + " OK, " + std::to_string(taken.again) + " to be looked at again, " +
           std::to_string(taken.taken_back) + " taken back",
       c.json);
  return taken.left_out.empty() ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
