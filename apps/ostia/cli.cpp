#include "cli.h"

#include "command_table.h"
#include "description_files.h"
#include "options/config_file.h"
#include "output/progress_bar.h"
#include "output/standard_streams.h"
#include "private_words.h"

#include "ostia/core/log.h"
#include "ostia/core/parallel.h"
#include "ostia/core/version.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <utility>

namespace ostia::app {
namespace {

/// What the command line asks for.
struct Asked {
  CLI::App app{"Ostia: from a cardiac CT angiogram to a vessel model that a solver can use", "ostia"};
  Commands commands;
  Run run;
  int exit_code = -1;  ///< 0 or more: all was said already (`--help`, a wrong option)
};

/// Every command and its options; nothing is asked yet.
std::unique_ptr<Asked> with_all_commands() {
  auto asked = std::make_unique<Asked>();
  asked->app.set_version_flag("--version", "ostia " + core::version());
  define(asked->app, asked->commands, asked->run);
  return asked;
}

/// A log that is kept must not name what a folder, a file or anything else was called. Whatever is written
/// from now on leaves it out, what the parser, a file of options and the reading of options refuse among it.
void keep_out_of_the_log(const CLI::App& app, const std::vector<std::string>& arguments) {
  const command_line::CommandDescription program = command_line::describe(app);
  core::never_redact(command_line::ordinary_words(program));
  const auto exists = [](const std::string& name) {
    std::error_code error;
    return std::filesystem::exists(name, error);
  };
  for (const auto& [text, alias] : command_line::private_paths(program, arguments, exists))
    core::redact_in_results(text, alias);
  if (command_line::value_of("--log", arguments) != "json") return;
  core::set_log(core::LogFormat::json, core::LogLevel::info);
  for (const auto& [text, alias] : command_line::private_words(program, arguments))
    core::redact_in_logs(text, alias);
}

enum class Refusals { printed, thrown };

/// `asked` has read no arguments yet.
std::unique_ptr<Asked> asked_by(std::unique_ptr<Asked> asked, const std::vector<std::string>& arguments,
                                Refusals refusals) {
  try {
    std::vector<std::string> words = arguments;
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    asked->app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (refusals == Refusals::thrown && error.get_exit_code() != 0) throw UsageError(error.what());
    std::ostringstream refusal;
    asked->exit_code =
        asked->app.exit(error, std::cout, refusal) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    std::cerr << core::redacted_for_log(refusal.str());
  }
  return asked;
}

int run_with(const std::vector<std::string>& arguments, Refusals refusals, const core::TaskContext& job) {
  if (const auto folder = command_line::described_into(arguments)) {
    Asked asked;
    define(asked.app, asked.commands, asked.run);
    command_line::write_description_files(command_line::describe(asked.app), *folder);
    return 0;
  }
  std::unique_ptr<Asked> asked = with_all_commands();
  keep_out_of_the_log(asked->app, arguments);
  const std::vector<std::string> all_arguments = with_config(arguments);
  if (all_arguments != arguments) keep_out_of_the_log(asked->app, all_arguments);
  StandardStreams streams(all_arguments);
  asked = asked_by(std::move(asked), streams.arguments(), refusals);
  if (asked->exit_code >= 0) return asked->exit_code;
  if (streams.used()) {
    streams.open();  // only now: a wrong option is told before the command in front has ended
    asked = asked_by(with_all_commands(), streams.arguments(), refusals);
  }
  const CommonOptions& common = asked->commands.common;
  core::set_max_threads(common.threads);
  core::set_log(common.log == "json" ? core::LogFormat::json : core::LogFormat::text,
                common.quiet ? core::LogLevel::error : core::LogLevel::info);
  const ProgressBar bar(job, common.quiet ? "none" : common.progress);
  const core::HeardWarnings heard;
  const ExitCode code = asked->run(job);
  if (code == ExitCode::ok || code == ExitCode::quality_failed) streams.deliver();
  return static_cast<int>(code);
}

}  // namespace

int run(const std::vector<std::string>& arguments, const core::TaskContext& job) {
  return run_with(arguments, Refusals::printed, job);
}

int run_within(const std::vector<std::string>& arguments, const core::TaskContext& job) {
  return run_with(arguments, Refusals::thrown, job);
}

}  // namespace ostia::app
