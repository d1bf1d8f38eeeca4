// `ostia cohort`: a folder for many scans, where they are, and their measures as tables.

#include "cohort/cohort.h"
#include "output/told.h"

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/measure_table.h"
#include "ostia/cohort/status.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>

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
  return {{"scans", status.scans},
          {"refused", status.refused},
          {"whole", status.whole},
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
}

}  // namespace ostia::app
