#include "chain/batch_results.h"
#include "chain/run.h"
#include "input/table_file.h"
#include "output/told.h"

#include "ostia/core/child_process.h"
#include "ostia/core/files.h"
#include "ostia/core/folder_lock.h"
#include "ostia/core/log.h"
#include "ostia/core/parallel.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

struct Case {
  std::string name;
  std::vector<std::string> settings;  ///< "column=value"
};

constexpr const char* results_name = "results.csv";
constexpr const char* logs_name = "logs";

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
    if (one.name == logs_name || one.name == results_name)
      throw InvalidInput(line + "the name " + one.name + " is kept for the batch's own; give another one");
    if (!names.insert(one.name).second) throw InvalidInput(line + "the case " + one.name + " is there twice");
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (c != at) one.settings.push_back(table.columns[c] + "=" + table.rows[r][c]);
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<std::string> names_of(const std::vector<Case>& cases) {
  std::vector<std::string> names;
  for (const Case& one : cases) names.push_back(one.name);
  return names;
}

class Batch {
 public:
  Batch(const BatchCommand& options, const CommonOptions& common, std::vector<Case> cases,
        const core::TaskContext& task)
      : options_(options),
        common_(common),
        cases_(std::move(cases)),
        task_(task),
        results_(options.output / results_name, names_of(cases_)) {}
  ExitCode run();

 private:
  void work();
  CaseOutcome run_one(const Case& one) const;
  void keep(const CaseOutcome& outcome);

  const BatchCommand& options_;
  const CommonOptions& common_;
  const std::vector<Case> cases_;
  const core::TaskContext& task_;
  BatchResults results_;
  std::atomic<std::size_t> next_{0};
  std::size_t done_ = 0, well_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

CaseOutcome Batch::run_one(const Case& one) const {
  const int threads =
      common_.threads > 0 ? common_.threads : std::max(1, core::max_threads() / std::max(1, options_.jobs));
  const fs::path folder = options_.output / one.name;
  std::vector<std::string> words{
      "run",       options_.chain.string(), "-o", folder.string(), "--log", "json", "--progress", "none",
      "--threads", std::to_string(threads)};
  for (const std::string& setting : one.settings) words.push_back("--set=" + setting);
  core::ChildLimits limits;
  limits.memory_bytes = std::uint64_t{1} << 40;
  limits.cpu_time = std::chrono::hours(240);
  const auto start = std::chrono::steady_clock::now();
  const core::ChildResult result = core::run_child(fs::read_symlink("/proc/self/exe"), words, limits, task_,
                                                   options_.output / logs_name / (one.name + ".log"));
  CaseOutcome out;
  out.name = one.name;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.peak_mb = result.peak_mb;
  out.exit_code = result.signal != 0 ? 128 + result.signal : result.exit_code;
  out.status = status_of(out.exit_code);
  if (out.status != "failed") {
    take_from_manifest(folder, out);  // the case's own time and memory, when it was done before, too
    return out;
  }
  out.message = last_error(result.standard_error);
  if (out.message.empty()) out.message = result.describe();
  return out;
}

void Batch::keep(const CaseOutcome& outcome) {
  const std::lock_guard lock(mutex_);
  if (!outcome.message.empty()) core::log_warning(outcome.name + ": " + outcome.message);
  if (outcome.status == "ok") ++well_;
  results_.keep(outcome);
  task_.set_progress(static_cast<double>(++done_) / static_cast<double>(cases_.size()));
}

void Batch::work() {
  try {
    while (true) {
      task_.throw_if_cancelled();
      const std::size_t at = next_++;
      if (at >= cases_.size()) return;
      keep(run_one(cases_[at]));
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
  if (failure_) {
    core::log_info("what is whole stays, cases and steps of cases; run again to go on");
    std::rethrow_exception(failure_);
  }
  tell("batch", {{"cases", cases_.size()}, {"well", well_}},
       std::to_string(well_) + " of " + std::to_string(cases_.size()) + " cases are well; " + results_name +
           " has them all",
       options_.json);
  return well_ == cases_.size() ? ExitCode::ok : ExitCode::quality_failed;
}

void make_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!fs::is_directory(folder))
    throw IoError("cannot make the folder " + folder.string() + ": " + failed.message());
}

}  // namespace

ExitCode run_batch(const BatchCommand& options, const CommonOptions& common, const core::TaskContext& task) {
  std::vector<Case> cases = cases_of(read_table(options.table), options.table);
  if (!fs::exists(options.chain))
    throw IoError("cannot read " + options.chain.string() + ": it is not there");
  make_folder(options.output);
  const core::FolderLock lock(options.output, options.output, "wait for it (--wait), or end it",
                              options.wait ? core::WhenBusy::wait : core::WhenBusy::refuse, task);
  make_folder(options.output / logs_name);
  const std::size_t left = core::remove_dead_parts(options.output);
  if (left > 0) core::log_info("took away " + std::to_string(left) + " leftovers of runs that were ended");
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
  one->add_flag("--json", chain.json, "One JSON object on standard output, and nothing of the steps'");
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
  many->add_flag("--wait", batch.wait,
                 "Wait where another batch is at work in the folder, instead of refusing");
  many->add_flag("--json", batch.json, "One JSON object on standard output");
  many->callback(
      [&] { run = [&](const core::TaskContext& task) { return run_batch(batch, common, task); }; });
}

}  // namespace ostia::app
