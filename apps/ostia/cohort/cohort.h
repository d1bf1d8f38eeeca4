#pragma once
/// \file `ostia cohort` and its subcommands: what they are told.

#include "commands.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct CohortInitCommand {
  std::filesystem::path table, output;
  bool skip_bad = false;
  bool json = false;
};
/// bad_input where rows cannot be used, all of which are printed; quality_failed where they were left out.
ExitCode run_cohort_init(const CohortInitCommand& options, const core::TaskContext& task);

struct CohortStatusCommand {
  std::filesystem::path cohort;
  bool verify = false;
  bool json = false;
};
ExitCode run_cohort_status(const CohortStatusCommand& options, const core::TaskContext& task);

struct CohortTableCommand {
  std::filesystem::path cohort, output;
  bool json = false;
};
ExitCode run_cohort_table(const CohortTableCommand& options, const core::TaskContext& task);

struct CohortPageCommand {
  std::filesystem::path cohort;
  bool json = false;
};
ExitCode run_cohort_page(const CohortPageCommand& options, const core::TaskContext& task);

struct CohortServeCommand {
  std::filesystem::path cohort;
  std::uint16_t port = 0;
  bool json = false;
};
/// Until it is interrupted, which is its ordinary end.
ExitCode run_cohort_serve(const CohortServeCommand& options, const core::TaskContext& task);

struct CohortReviewCommand {
  std::filesystem::path cohort, file;
  bool json = false;
};
/// quality_failed where a reviewed case is not there, or was made anew since.
ExitCode run_cohort_review(const CohortReviewCommand& options, const core::TaskContext& task);

struct CohortCompareCommand {
  std::filesystem::path before, after, output;
  bool json = false;
};
ExitCode run_cohort_compare(const CohortCompareCommand& options, const core::TaskContext& task);

struct CohortCrateCommand {
  std::filesystem::path cohort;
  std::string name, license;
  bool json = false;
};
/// quality_failed where results were left out whose records do not say what made them.
ExitCode run_cohort_crate(const CohortCrateCommand& options, const core::TaskContext& task);

struct CohortReproduceCommand {
  std::filesystem::path crate, output, private_folder;
  std::size_t only = 0;
  bool json = false;
};
/// quality_failed where a file differs or is missing.
ExitCode run_cohort_reproduce(const CohortReproduceCommand& options, const core::TaskContext& task);

struct CohortStatisticsCommand {
  std::filesystem::path tables, reference, output;
  bool json = false;
};
ExitCode run_cohort_statistics(const CohortStatisticsCommand& options, const core::TaskContext& task);

struct CohortCommands {
  CohortInitCommand init;
  CohortStatusCommand status;
  CohortTableCommand table;
  CohortPageCommand page;
  CohortReviewCommand review;
  CohortServeCommand serve;
  CohortCompareCommand compare;
  CohortCrateCommand crate;
  CohortReproduceCommand reproduce;
  CohortStatisticsCommand statistics;
};

/// Adds `cohort` with its subcommands.
void define_cohort(CLI::App& app, CohortCommands& cohort,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
