#include "chain.h"
#include "run.h"
#include "table_file.h"

#include "ostia/core/child_process.h"
#include "ostia/core/csv.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/parallel.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

struct Case {
  std::string name;
  std::vector<std::string> settings;  ///< "column=value"
};
struct Outcome {
  std::string status;  ///< "", "ok", "quality", "failed"
  int exit_code = 0;
  double seconds = 0.0;
  std::string message;
};

bool plain(const std::string& name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-'; };
  return !name.empty() && name[0] != '.' && name[0] != '-' && std::all_of(name.begin(), name.end(), fits);
}

/// The column `case` names a case's folder; the others are the chain's variables.
std::vector<Case> cases_of(const Table& table, const fs::path& file) {
  const auto column = std::find(table.columns.begin(), table.columns.end(), "case");
  if (column == table.columns.end())
    throw InvalidInput("cannot use " + file.string() + ": it has no column `case`, which names the folders");
  const auto at = static_cast<std::size_t>(column - table.columns.begin());
  std::vector<Case> out;
  std::set<std::string> names;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    Case one{table.rows[r][at], {}};
    const std::string line =
        "cannot use " + file.string() + ": line " + std::to_string(table.lines[r]) + ": ";
    if (!plain(one.name))
      throw InvalidInput(line + "the case's name \"" + one.name +
                         "\" becomes a folder: letters, digits, dots, dashes and underscores alone");
    if (!names.insert(one.name).second) throw InvalidInput(line + "the case " + one.name + " is there twice");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (c != at) one.settings.push_back(table.columns[c] + "=" + table.rows[r][c]);
    out.push_back(std::move(one));
  }
  return out;
}

/// The last error of a log in JSON, which holds no path.
std::string last_error(const std::string& log) {
  std::string message;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const json entry = json::parse(line, nullptr, false);
    if (entry.is_object() && entry.value("level", "") == "error") message = entry.value("message", "");
  }
  return message;
}

class Batch {
 public:
  Batch(const BatchCommand& options, const CommonOptions& common, std::vector<Case> cases,
        const core::TaskContext& task)
      : options_(options), common_(common), cases_(std::move(cases)), task_(task), outcomes_(cases_.size()) {}
  ExitCode run();

 private:
  void work();
  Outcome run_one(const Case& one) const;
  void keep(std::size_t at, Outcome outcome);
  void write_table() const;

  const BatchCommand& options_;
  const CommonOptions& common_;
  const std::vector<Case> cases_;
  const core::TaskContext& task_;
  std::vector<Outcome> outcomes_;
  std::atomic<std::size_t> next_{0};
  std::size_t done_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

Outcome Batch::run_one(const Case& one) const {
  const int threads =
      common_.threads > 0 ? common_.threads : std::max(1, core::max_threads() / std::max(1, options_.jobs));
  std::vector<std::string> words{"run",
                                 options_.chain.string(),
                                 "-o",
                                 (options_.output / one.name).string(),
                                 "--log",
                                 "json",
                                 "--quiet",
                                 "--threads",
                                 std::to_string(threads)};
  for (const std::string& setting : one.settings) words.push_back("--set=" + setting);
  core::ChildLimits limits;
  limits.memory_bytes = std::uint64_t{1} << 40;
  limits.cpu_time = std::chrono::hours(240);
  const auto start = std::chrono::steady_clock::now();
  const core::ChildResult result = core::run_child(fs::read_symlink("/proc/self/exe"), words, limits, task_);
  Outcome out;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.exit_code = result.signal != 0 ? 128 + result.signal : result.exit_code;
  out.status = out.exit_code == 0                                            ? "ok"
               : out.exit_code == static_cast<int>(ExitCode::quality_failed) ? "quality"
                                                                             : "failed";
  if (out.status == "failed") {
    out.message = last_error(result.standard_error);
    if (out.message.empty()) out.message = result.describe();
  }
  return out;
}

void Batch::write_table() const {
  std::string text = core::csv_line({"case", "status", "exit_code", "seconds", "message"});
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const Outcome& one = outcomes_[i];
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.1f", one.seconds);
    if (!one.status.empty())
      text +=
          core::csv_line({cases_[i].name, one.status, std::to_string(one.exit_code), seconds, one.message});
  }
  core::write_file(options_.output / "results.csv", text);
}

void Batch::keep(std::size_t at, Outcome outcome) {
  const std::lock_guard lock(mutex_);
  if (outcome.status == "failed") core::log_warning(cases_[at].name + ": " + outcome.message);
  outcomes_[at] = std::move(outcome);
  write_table();
  task_.set_progress(static_cast<double>(++done_) / static_cast<double>(cases_.size()));
}

void Batch::work() {
  try {
    while (true) {
      task_.throw_if_cancelled();
      const std::size_t at = next_++;
      if (at >= cases_.size()) return;
      keep(at, run_one(cases_[at]));
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    next_ = cases_.size();
  }
}

ExitCode Batch::run() {
  task_.set_stage("cases");
  std::vector<std::thread> workers;
  const int count = std::min(options_.jobs, static_cast<int>(cases_.size()));
  for (int i = 0; i < count; ++i) workers.emplace_back([this] { work(); });
  for (std::thread& worker : workers) worker.join();
  if (failure_) std::rethrow_exception(failure_);
  const auto well = std::count_if(outcomes_.begin(), outcomes_.end(),
                                  [](const Outcome& one) { return one.status == "ok"; });
  std::printf("%zd of %zu cases are well; %s has them all\n", well, cases_.size(), "results.csv");
  return static_cast<std::size_t>(well) == cases_.size() ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace

ExitCode run_batch(const BatchCommand& options, const CommonOptions& common, const core::TaskContext& task) {
  std::vector<Case> cases = cases_of(read_table(options.table), options.table);
  if (!fs::exists(options.chain))
    throw IoError("cannot read " + options.chain.string() + ": it is not there");
  std::error_code failed;
  fs::create_directory(options.output, failed);
  if (!fs::is_directory(options.output))
    throw IoError("cannot make the folder " + options.output.string() + ": " + failed.message());
  return Batch(options, common, std::move(cases), task).run();
}

void define_run(CLI::App& app, RunCommand& chain, BatchCommand& batch, const CommonOptions& common,
                std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* one = app.add_subcommand("run", "A chain of commands from a JSON file");
  one->footer("Example:\n  ostia run pipeline.json -o out --set ct=heart.nrrd");
  one->fallthrough();
  one->add_option("PIPELINE", chain.chain, "The chain, .json")->required();
  one->add_option("-o,--output", chain.output,
                  "Folder that is made; left out: the chain's name without .json");
  one->add_option("--set", chain.variables, "name=value of a variable; repeat")->allow_extra_args(false);
  one->callback([&] {
    if (chain.output.empty()) chain.output = fs::path(chain.chain).replace_extension();
    run = [&](const core::TaskContext& task) { return run_chain(chain, common, task); };
  });

  CLI::App* many = app.add_subcommand("batch", "A chain of commands for every row of a table");
  many->footer("Example:\n  ostia batch patients.csv --pipeline pipeline.json -o out --jobs 2");
  many->fallthrough();
  many->add_option("TABLE", batch.table, "CSV with a column `case`; the others are the chain's variables")
      ->required();
  many->add_option("--pipeline", batch.chain, "The chain, .json")->required();
  many->add_option("-o,--output", batch.output, "Folder of the cases' folders and results.csv")->required();
  many->add_option("--jobs", batch.jobs, "Cases at a time")->check(CLI::Range(1, 256));
  many->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_batch(batch, common, task); }; });
}

}  // namespace ostia::app
