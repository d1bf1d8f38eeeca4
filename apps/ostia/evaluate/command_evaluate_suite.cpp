#include "evaluate/evaluate.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/evaluation/suite.h"
#include "ostia/evaluation/suite_report.h"

#include <cstdio>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

bool is_page(const fs::path& path) {
  return path.extension() == ".html" || path.extension() == ".htm";
}

/// A page alone, or a folder with report.html and suite.json.
void write_report(const EvaluateCommand& command, const evaluation::SuiteResult& suite,
                  const core::TaskContext& task) {
  if (is_page(command.report)) {
    evaluation::write_suite_report(command.report, suite, command.reference, command.result, {}, task);
    return;
  }
  core::StagedFolder staged(command.report);
  evaluation::write_suite_report(staged.temporary() / "report.html", suite, command.reference, command.result,
                                 {}, task);
  core::write_file(staged.temporary() / "suite.json", evaluation::suite_json(suite));
  staged.commit();
}

void require_report_place(const fs::path& path) {
  if (path.empty() || is_page(path) || !fs::exists(path)) return;
  if (!fs::is_directory(path) || (!fs::is_empty(path) && !fs::exists(path / "suite.json")))
    throw UsageError("cannot write the report to " + path.string() +
                     ": it is there and holds something else; name a new folder or a file.html");
}

}  // namespace

ExitCode run_evaluate_suite(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  require_report_place(command.report);
  const evaluation::Tolerances tolerances = command.tolerance.empty()
                                                ? evaluation::default_tolerances()
                                                : evaluation::read_tolerances(command.tolerance);
  const evaluation::SuiteResult suite =
      evaluation::compare_suites(command.reference, command.result, tolerances, task.sub(0.0, 0.7));
  if (!command.report.empty()) write_report(command, suite, task.sub(0.7, 1.0));
  std::fputs(command.json ? evaluation::suite_json(suite).c_str() : evaluation::suite_text(suite).c_str(),
             stdout);
  task.set_progress(1.0);
  if (suite.passed()) return ExitCode::ok;
  core::log_warning("the new run is worse than the golden one, or lacks something: a person must look");
  return ExitCode::quality_failed;
}

}  // namespace ostia::app
