#pragma once
/// \file `ostia run` and `ostia batch`: what they are told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct RunCommand {
  std::filesystem::path chain, output;
  std::vector<std::string> variables;  ///< "name=value"
};
/// Every step in turn, in a folder that appears whole. quality_failed where one of them says so.
ExitCode run_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task);

struct BatchCommand {
  std::filesystem::path table, chain, output;
  int jobs = 1;
};
/// A chain for every row of a table, each in a process of its own. Cases that are whole already are left
/// alone; one that fails stops no other. ok where all are well, else quality_failed.
ExitCode run_batch(const BatchCommand& options, const CommonOptions& common, const core::TaskContext& task);

/// Adds `run` and `batch`.
void define_run(CLI::App& app, RunCommand& chain, BatchCommand& batch, const CommonOptions& common,
                std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
