#include "ostia/solver/openfoam_outcome.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"
#include "ostia/solver/openfoam_result.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using core::shortest_text;

constexpr double largest_cycle_change = 0.01;
constexpr double same_outcome_time = 1e-6;  // of a period

std::optional<double> as_number(const std::string& word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

/// `file` in each folder of postProcessing/<function>, by the time at which that part of the run began.
std::vector<std::pair<double, fs::path>> parts_of(const fs::path& case_folder, const std::string& function,
                                                  const std::string& file) {
  std::error_code error;
  std::vector<std::pair<double, fs::path>> parts;
  for (const auto& entry : fs::directory_iterator(case_folder / "postProcessing" / function, error)) {
    const auto start = as_number(entry.path().filename().string());
    if (start && fs::exists(entry.path() / file, error)) parts.emplace_back(*start, entry.path() / file);
  }
  std::ranges::sort(parts);
  return parts;
}

/// Straight between its values.
double value_at(const OpenfoamSeries& series, double time) {
  const auto after = series.lower_bound(time);
  if (after == series.begin()) return after->second;
  if (after == series.end()) return series.rbegin()->second;
  const auto before = std::prev(after);
  const double share = (time - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

std::map<std::string, double> last_residuals(const fs::path& case_folder) {
  std::map<std::string, double> residuals;
  const auto parts = parts_of(case_folder, "residuals", "solverInfo.dat");
  if (parts.empty()) return residuals;
  std::istringstream text(core::read_file(parts.back().second));
  std::vector<std::string> names, values;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("# Time"))
      names = words_of(line.substr(1));
    else if (!line.empty() && !line.starts_with('#'))
      values = words_of(line);
  }
  const std::string end = "_initial";
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
    const auto value = as_number(values[i]);
    if (names[i].ends_with(end) && value)
      residuals[names[i].substr(0, names[i].size() - end.size())] = *value;
  }
  return residuals;
}

std::optional<double> largest_courant(const std::string& log) {
  std::optional<double> largest;
  const std::string mark = "Courant Number mean:";
  for (std::size_t at = log.find(mark); at != std::string::npos; at = log.find(mark, at + 1)) {
    const std::vector<std::string> words = words_of(log.substr(at, log.find('\n', at) - at));
    const auto value = as_number(words.back());
    if (value) largest = std::max(largest.value_or(0.0), *value);
  }
  return largest;
}

/// Relative change of the inlets' mean pressures from the last cycle but one to the last.
std::optional<double> change_of_cycle(const fs::path& case_folder, const std::vector<std::string>& inlets,
                                      double last, double period) {
  if (last < 2.0 * period * (1.0 - same_outcome_time)) return std::nullopt;
  double largest = 0.0;
  for (const std::string& inlet : inlets) {
    const OpenfoamSeries pressure = read_openfoam_series(case_folder, "pressure_" + inlet);
    const double now = cycle_mean(pressure, last, period),
                 before = cycle_mean(pressure, last - period, period);
    largest = std::max(largest, std::abs(now - before) / std::max(std::abs(now), 1e-300));
  }
  return largest;
}

void judge_steady(const std::string& log, const fs::path& log_file, OpenfoamOutcome& run) {
  // A log holds several runs where one was continued.
  const std::size_t start = log.rfind("Starting time loop");
  run.converged =
      log.find("solution converged in", start == std::string::npos ? 0 : start) != std::string::npos;
  if (run.converged) return;
  run.not_converged =
      log.empty() ? "it is not known whether the run converged: there is no " + log_file.filename().string()
                  : "the run ended after " + shortest_text(run.last) +
                        " iterations without reaching its bounds of the residuals (endTime and "
                        "residualControl in system): let it go on with `ostia case CASE --iterations " +
                        std::to_string(2 * std::lround(run.last)) + "` and ./Allrun again";
}

void judge_pulsatile(const CaseRecord& record, OpenfoamOutcome& run) {
  const double end = record.period_s * record.cycles;
  if (run.last < end * (1.0 - same_outcome_time)) {
    run.not_converged = "the run has reached " + shortest_text(run.last) + " s of its " +
                        shortest_text(std::round(1e6 * end) / 1e6) + " s";
  } else if (run.cycle_change && *run.cycle_change > largest_cycle_change) {
    run.not_converged = "the last two cycles differ by " +
                        shortest_text(std::round(1e3 * *run.cycle_change) / 10) +
                        " % in the inlets' mean pressure: let it go on with `ostia case CASE --cycles " +
                        std::to_string(record.cycles + 2) + "` and ./Allrun again";
  }
  run.converged = run.not_converged.empty();
}

}  // namespace

OpenfoamSeries read_openfoam_series(const fs::path& case_folder, const std::string& function) {
  OpenfoamSeries series;
  for (const auto& [start, file] : parts_of(case_folder, function, "surfaceFieldValue.dat")) {
    // What an earlier part has beyond, it had not written a result of.
    series.erase(series.upper_bound(start), series.end());
    std::istringstream text(core::read_file(file));
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with('#')) continue;
      const std::vector<std::string> words = words_of(line);
      const auto time = words.empty() ? std::nullopt : as_number(words[0]),
                 value = words.size() < 2 ? std::nullopt : as_number(words[1]);
      if (time && value) series[*time] = *value;
    }
  }
  if (series.empty())
    throw InvalidInput(
        (case_folder / "postProcessing" / function).string() +
        " holds no values: the case's own functions (system/controlDict) write them as it runs");
  return series;
}

double cycle_mean(const OpenfoamSeries& series, double last, double period) {
  const double first = last - period, slack = same_outcome_time * period;
  const double from_start = series.empty() ? last : series.begin()->first;
  // The first step is not at 0; what lies before it is as it.
  const double step = series.size() > 1 ? std::next(series.begin())->first - from_start : 0.0;
  if (series.empty() || series.rbegin()->first < last - slack || from_start > first + step + slack)
    throw InvalidInput("there are no values over the whole cycle from " + shortest_text(first) + " to " +
                       shortest_text(last) + " s");
  double sum = 0.0, time = first, value = value_at(series, first);
  const auto add = [&](double next, double at_next) {
    sum += 0.5 * (value + at_next) * (next - time);
    time = next;
    value = at_next;
  };
  for (auto at = series.upper_bound(first); at != series.end() && at->first < last; ++at)
    add(at->first, at->second);
  add(last, value_at(series, last));
  return sum / period;
}

OpenfoamOutcome read_openfoam_outcome(const fs::path& case_folder, const CaseRecord& record,
                                      const std::vector<std::string>& inlets) {
  OpenfoamOutcome run;
  run.program = record.pulsatile() ? "pimpleFoam" : "simpleFoam";
  std::error_code error;
  // Of a case that version 0.1 wrote.
  if (record.pulsatile() && fs::exists(case_folder / "log.pisoFoam", error)) run.program = "pisoFoam";
  const std::vector<OpenfoamTime> times = times_of(case_folder);
  if (!times.empty()) run.last = times.back().time;
  run.residuals = last_residuals(case_folder);
  const fs::path log_file = case_folder / ("log." + run.program);
  const std::string log = fs::exists(log_file, error) ? core::read_file(log_file) : "";
  if (record.pulsatile()) {
    run.largest_courant = largest_courant(log);
    run.cycle_change = change_of_cycle(case_folder, inlets, run.last, record.period_s);
    judge_pulsatile(record, run);
  } else {
    judge_steady(log, log_file, run);
  }
  return run;
}

}  // namespace ostia::solver
