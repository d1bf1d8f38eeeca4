#include "chain/batch_results.h"

#include "input/table_file.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/pipeline/manifest.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

const std::vector<std::string> result_columns{"case", "status", "exit_code", "seconds", "message", "peak_mb"};

double number_in(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// By names of columns, so that tables of other versions are read as far as they go.
std::vector<CaseOutcome> read_outcomes(const fs::path& file) {
  std::vector<CaseOutcome> outcomes;
  Table table;
  try {
    table = read_table(file);
  } catch (const Error&) {
    return outcomes;
  }
  for (const std::vector<std::string>& row : table.rows) {
    const auto cell = [&](const std::string& column) {
      const auto at = std::find(table.columns.begin(), table.columns.end(), column);
      return at == table.columns.end() ? std::string()
                                       : row[static_cast<std::size_t>(at - table.columns.begin())];
    };
    outcomes.push_back({cell("case"), cell("status"), static_cast<int>(number_in(cell("exit_code"))),
                        number_in(cell("seconds")), number_in(cell("peak_mb")), cell("message")});
  }
  return outcomes;
}

}  // namespace

std::string status_of(int exit_code) {
  return exit_code == 0                                            ? "ok"
         : exit_code == static_cast<int>(ExitCode::quality_failed) ? "quality"
                                                                   : "failed";
}

BatchResults::BatchResults(fs::path file, const std::vector<std::string>& cases) : file_(std::move(file)) {
  const std::vector<CaseOutcome> known =
      fs::exists(file_) ? read_outcomes(file_) : std::vector<CaseOutcome>();
  const auto named = [](const std::vector<CaseOutcome>& outcomes, const std::string& name) {
    return std::find_if(outcomes.begin(), outcomes.end(),
                        [&](const CaseOutcome& one) { return one.name == name; });
  };
  for (const std::string& name : cases) {
    const auto before = named(known, name);
    outcomes_.push_back(before != known.end() ? *before : CaseOutcome{name, "", 0, 0.0, 0.0, ""});
  }
  for (const CaseOutcome& one : known)
    if (named(outcomes_, one.name) == outcomes_.end()) outcomes_.push_back(one);
}

void BatchResults::keep(const CaseOutcome& outcome) {
  const auto at = std::find_if(outcomes_.begin(), outcomes_.end(),
                               [&](const CaseOutcome& one) { return one.name == outcome.name; });
  if (at == outcomes_.end())
    outcomes_.push_back(outcome);
  else
    *at = outcome;
  std::string text = core::csv_line(result_columns);
  for (const CaseOutcome& one : outcomes_)
    if (!one.status.empty())
      text +=
          core::csv_line({one.name, one.status, std::to_string(one.exit_code),
                          core::fixed_text(one.seconds, 1), one.message, core::fixed_text(one.peak_mb, 0)});
  core::write_file(file_, text);
}

void take_from_manifest(const fs::path& folder, CaseOutcome& outcome) {
  try {
    const json manifest = json::parse(pipeline::manifest_of(folder));
    outcome.exit_code = manifest.at("exit_code").get<int>();
    outcome.seconds = manifest.at("seconds").get<double>();
    outcome.peak_mb = manifest.at("peak_mb").get<double>();
    outcome.message.clear();
    for (const json& warning : manifest.at("warnings"))
      outcome.message += (outcome.message.empty() ? "" : "; ") + warning.get<std::string>();
  } catch (const json::exception&) {
    // What the process said of itself stands.
  }
  outcome.status = status_of(outcome.exit_code);
}

std::string last_error(const std::string& log) {
  std::string message;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const json entry = json::parse(line, nullptr, false);
    if (entry.is_object() && entry.value("level", "") == "error") message = entry.value("message", "");
  }
  return message;
}

}  // namespace ostia::app
