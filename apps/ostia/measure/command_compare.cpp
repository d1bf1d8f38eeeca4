#include "input/table_file.h"
#include "measure/compare.h"
#include "measure/compare_pair.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/text.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t most_table_bytes = 16ULL << 20;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

session::ComparisonOptions compare_options(const CompareCommand& c) {
  session::ComparisonOptions options;
  options.anyway = c.anyway;
  if (!c.repeatability.empty())
    options.change.repeatability = session::repeatability_of_json(
        core::read_file(c.repeatability, most_table_bytes), c.repeatability.string());
  analysis::validate(options.change);
  return options;
}

ExitCode code_of(const session::Comparison& made) {
  return made.another_patient.empty() ? ExitCode::ok : ExitCode::quality_failed;
}

std::string told_number(const nlohmann::json& value, int decimals) {
  return value.is_null() ? std::string("-") : core::rounded_text(value.get<double>(), decimals);
}

void print_comparison(const nlohmann::json& result) {
  for (const auto& lesion : result["lesions"]) {
    std::printf("%s, %s:", lesion["vessel"].get<std::string>().c_str(),
                lesion["fate"].get<std::string>().c_str());
    for (const auto& [key, one] : lesion["measures"].items())
      if (key == "mla_mm2" || key == "plaque_mm3" || key == "stenosis_percent")
        std::printf(" %s %s -> %s (%s)", key.c_str(), told_number(one["before"], 2).c_str(),
                    told_number(one["after"], 2).c_str(), one["verdict"].get<std::string>().c_str());
    std::printf("\n");
  }
  std::printf("%zu lesions, %zu segments, %zu vessels compared\n", result["lesions"].size(),
              result["segments"].size(), result["vessels"].size());
  for (const auto& one : result["unmatched"]) std::printf("%s\n", one.get<std::string>().c_str());
}

ExitCode compare_pair(const CompareCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const session::ComparisonOptions options = compare_options(c);
  const session::MapBy by = session::map_by(c.map);
  pipeline::require_free_folder(c.output);
  const OpenedPair pair({c.before, c.after, c.before_image, c.after_image});
  const pipeline::JobKey job = pair.job(options, by);
  std::optional<ExitCode> code = pipeline::already_done(c.output, job);
  if (code) {
    core::log_info("done already with the same cases and parameters; nothing to do");
  } else {
    const session::Comparison made = pair.compared(options, by, task.sub(0.0, 0.9));
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    code = code_of(made);
    session::write_comparison(c.output, made, job, *code, seconds_since(start), task.sub(0.9, 1.0));
  }
  const std::string result = core::read_file(c.output / "comparison.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print_comparison(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return *code;
}

struct NamedPair {
  std::string name;
  PairPaths paths;
};

bool names_folder(const std::string& name) {
  return !name.empty() && name.size() <= 64 && name[0] != '.' && name[0] != '-' &&
         std::ranges::all_of(
             name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-'; });
}

/// Columns `pair`, `old`, `new` and, where there are images, `old_image`, `new_image`; files beside the
/// table.
std::vector<NamedPair> pairs_of(const fs::path& file) {
  const Table table = read_table(file);
  const auto column = [&](const std::string& name, bool needed) -> std::optional<std::size_t> {
    const auto found = std::ranges::find(table.columns, name);
    if (found != table.columns.end()) return static_cast<std::size_t>(found - table.columns.begin());
    if (needed) throw InvalidInput(file.string() + ": it has no column `" + name + "`");
    return std::nullopt;
  };
  const auto name = column("pair", true), before = column("old", true), after = column("new", true);
  const auto before_image = column("old_image", false), after_image = column("new_image", false);
  const auto path = [&](std::size_t row, std::optional<std::size_t> at) {
    const std::string& text = at ? table.rows[row][*at] : std::string();
    return text.empty() ? fs::path() : file.parent_path() / text;
  };
  std::vector<NamedPair> pairs;
  std::set<std::string> names;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string line = file.string() + ": line " + std::to_string(table.lines[r]) + ": ";
    NamedPair one{table.rows[r][*name],
                  {path(r, before), path(r, after), path(r, before_image), path(r, after_image)}};
    if (!names_folder(one.name))
      throw InvalidInput(line + "the pair's name \"" + one.name +
                         "\" becomes a folder: letters, digits, dots, dashes and underscores alone");
    if (one.name == "cohort.json" || one.name == "cohort.csv" || one.name == "cohort.html" ||
        one.name == "manifest.json" || !names.insert(one.name).second)
      throw InvalidInput(line + "the pair's name " + one.name + " is taken; give another one");
    if (one.paths.before.empty() || one.paths.after.empty())
      throw InvalidInput(line + "a pair needs two cases, `old` and `new`");
    pairs.push_back(std::move(one));
  }
  if (pairs.empty()) throw InvalidInput(file.string() + ": it has no pair");
  return pairs;
}

ExitCode compare_cohort(const CompareCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const session::ComparisonOptions options = compare_options(c);
  const session::MapBy by = session::map_by(c.map);
  pipeline::require_free_folder(c.output);
  const std::vector<NamedPair> pairs = pairs_of(c.pairs);
  core::StagedFolder staged(c.output);
  std::vector<session::CohortRow> rows;
  std::vector<std::string> warnings;
  pipeline::JobKey job{
      "compare pairs", {{"table", core::sha256_file(c.pairs)}}, comparison_parameters(options, by)};
  ExitCode code = ExitCode::ok;
  const auto not_well = [&](const std::string& what) {
    code = ExitCode::quality_failed;
    warnings.push_back(what);
    core::log_warning(what);
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const NamedPair& one = pairs[i];
    const auto part = task.sub(static_cast<double>(i) / static_cast<double>(pairs.size()),
                               static_cast<double>(i + 1) / static_cast<double>(pairs.size()));
    try {
      const OpenedPair pair(one.paths);
      const session::Comparison made = pair.compared(options, by, part.sub(0.0, 0.9));
      const auto found = session::cohort_rows(one.name, made);
      rows.insert(rows.end(), found.begin(), found.end());
      if (code_of(made) != ExitCode::ok) not_well(one.name + ": hardly one patient: " + made.another_patient);
      session::write_comparison(staged.temporary() / one.name, made, pair.job(options, by), code_of(made),
                                0.0, part.sub(0.9, 1.0));
    } catch (const Error& error) {
      if (error.exit_code() != ExitCode::bad_input) throw;
      not_well(one.name + ": not compared: " + error.what());
    }
  }
  if (rows.empty()) throw InvalidInput(c.pairs.string() + ": no pair could be compared; " + warnings.front());
  const std::string result = session::cohort_json(rows, warnings);
  core::write_file(staged.temporary() / "cohort.json", result);
  core::write_file(staged.temporary() / "cohort.csv", session::cohort_csv(rows));
  core::write_file(staged.temporary() / "cohort.html", session::cohort_html(rows, warnings));
  pipeline::write_manifest(staged.temporary(), {job, code, seconds_since(start), warnings, "{}"});
  staged.commit();
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    std::printf("%zu pairs, %zu values compared; cohort.html, cohort.csv, cohort.json, a folder each pair\n",
                pairs.size(), rows.size());
  task.set_progress(1.0);
  return code;
}

}  // namespace

ExitCode run_compare(const CompareCommand& c, const core::TaskContext& task) {
  if (!c.pairs.empty()) {
    if (!c.before.empty() || !c.before_image.empty() || !c.after_image.empty())
      throw UsageError("compare: --pairs stands in place of OLD, NEW and their images");
    return compare_cohort(c, task);
  }
  if (c.before.empty() || c.after.empty())
    throw UsageError("compare: give two cases, OLD and NEW, or a table of them with --pairs");
  return compare_pair(c, task);
}

void define_compare(CLI::App& app, CompareCommand& c,
                    std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* compare = app.add_subcommand(
      "compare", "What changed between two scans of one patient: lesions, segments, plaque");
  compare->footer(
      "Example:\n  ostia compare old.ostia new.ostia -o changes\n  ostia compare --pairs trial.csv -o trial");
  compare->fallthrough();
  compare->add_option("OLD", c.before, "Case of the former scan (.ostia)");
  compare->add_option("NEW", c.after, "Case of the later scan (.ostia)");
  compare->add_option("--old-image", c.before_image,
                      "The CT that OLD was made with: DICOM folder or image; left out: no plaque, no fat");
  compare->add_option("--new-image", c.after_image, "The CT that NEW was made with, likewise");
  compare->add_option("--pairs", c.pairs,
                      "CSV table of pairs in place of OLD and NEW: columns pair, old, new and, with images, "
                      "old_image, new_image; paths from the table's folder on");
  compare->add_option("--repeatability", c.repeatability,
                      "cohort.json of pairs of unchanged patients: by how much two scans differ anyway; left "
                      "out: differences are told, and none is called a change");
  compare
      ->add_option("-o,--output", c.output,
                   "Folder that is made: comparison.html, .pdf, .json, .csv, images; with --pairs "
                   "cohort.html, .json, .csv and a folder a pair")
      ->required();
  compare
      ->add_option("--map", c.map,
                   "What lays the scans onto each other: trees, images, or any: the images where both are "
                   "given and fit well")
      ->check(CLI::IsMember({"any", "trees", "images"}));
  compare->add_flag("--anyway", c.anyway, "Compare trees that are hardly of one patient, too (exit code 4)");
  compare->add_flag("--json", c.json, "comparison.json, or cohort.json, on standard output");
  compare->callback([&] { run = [&](const core::TaskContext& task) { return run_compare(c, task); }; });
}

}  // namespace ostia::app
