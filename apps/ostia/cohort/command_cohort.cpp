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

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

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

namespace {

using CohortRun = std::function<ExitCode(const core::TaskContext&)>;

template <class Command>
CLI::App* add_cohort(CLI::App& cohort, const char* name, const char* text, const char* example,
                     Command& command, ExitCode (*one)(const Command&, const core::TaskContext&),
                     CohortRun& run) {
  CLI::App* sub = cohort.add_subcommand(name, text);
  sub->footer(std::string("Example:\n  ") + example);
  sub->fallthrough();
  sub->callback([&command, &run, one] {
    run = [&command, one](const core::TaskContext& task) { return one(command, task); };
  });
  sub->add_flag("--json", command.json, "One JSON object on standard output");
  return sub;
}

}  // namespace

void define_cohort(CLI::App& app, CohortCommands& c, CohortRun& run) {
  CLI::App* cohort =
      app.add_subcommand("cohort", "Many scans in one folder: begun from a table, looked over, measured");
  cohort->footer("Example:\n  ostia cohort init scans.csv -o study");
  cohort->fallthrough();
  cohort->require_subcommand(1);

  CLI::App* init =
      add_cohort(*cohort, "init", "A folder for a cohort from a table of scans, checked row by row",
                 "ostia cohort init scans.csv -o study", c.init, run_cohort_init, run);
  init->add_option(
          "TABLE", c.init.table,
          "CSV table, a row a scan: columns id, scan and, where wanted, patient, kind, series; paths from "
          "the table's folder on")
      ->required();
  init->add_option("-o,--output", c.init.output,
                   "Folder that is made; beside it one with .private, for the key and the names")
      ->required();
  init->add_flag("--skip-bad", c.init.skip_bad,
                 "Leave rows out that cannot be used (exit code 4), instead of making nothing");

  CLI::App* status = add_cohort(*cohort, "status", "How many scans are how far, and why others failed",
                                "ostia cohort status study", c.status, run_cohort_status, run);
  status->add_option("COHORT", c.status.cohort, "Folder of the cohort")->required();
  status->add_flag("--verify", c.status.verify, "Compute the digest of every file that was made, too");

  CLI::App* table =
      add_cohort(*cohort, "table", "The measures of all scans as tidy tables with a data dictionary",
                 "ostia cohort table study -o tables", c.table, run_cohort_table, run);
  table->add_option("COHORT", c.table.cohort, "Folder of the cohort")->required();
  table
      ->add_option("-o,--output", c.table.output,
                   "Folder that is made: scans.csv, measures.csv, dictionary.csv, measures.sqlite")
      ->required();

  CLI::App* page = add_cohort(*cohort, "page", "A page for a browser: counts, failures, pictures, reviews",
                              "ostia cohort page study", c.page, run_cohort_page, run);
  page->add_option("COHORT", c.page.cohort, "Folder of the cohort; its folder page is made")->required();

  CLI::App* serve =
      add_cohort(*cohort, "serve", "That page on this machine's loopback, which writes reviews itself",
                 "ostia cohort serve study", c.serve, run_cohort_serve, run);
  serve->add_option("COHORT", c.serve.cohort, "Folder of the cohort; its page is made anew")->required();
  serve->add_option("--port", c.serve.port, "Port of 127.0.0.1; 0: one that is free");

  CLI::App* compare =
      add_cohort(*cohort, "compare", "The same scans in two cohorts: what changed for whom",
                 "ostia cohort compare release-1 release-2 -o changes", c.compare, run_cohort_compare, run);
  compare->add_option("BEFORE", c.compare.before, "Folder of a cohort")->required();
  compare->add_option("AFTER", c.compare.after, "Folder of another one, of the same scans")->required();
  compare
      ->add_option("-o,--output", c.compare.output, "Folder that is made: index.html, changes.csv, pictures")
      ->required();

  CLI::App* review =
      add_cohort(*cohort, "review", "What a person said of the cases on that page, taken into the cohort",
                 "ostia cohort review study reviews.json", c.review, run_cohort_review, run);
  review->add_option("COHORT", c.review.cohort, "Folder of the cohort")->required();
  review->add_option("FILE", c.review.file, "Reviews that the page exported")->required();
}

}  // namespace ostia::app
