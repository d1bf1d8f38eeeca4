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
  bool json = false;
};
/// Every step in turn, in a folder that appears whole. quality_failed where one of them says so. Steps that
/// an earlier run did for the same folder, from the same inputs with the same words, are not done again.
ExitCode run_chain(const RunCommand& options, const CommonOptions& common, const core::TaskContext& task);

struct BatchCommand {
  std::filesystem::path table, chain, output;
  int jobs = 1;
  bool json = false;
  bool wait = false;  ///< where another batch is at work in the folder
};
/// A chain for every row of a table, each in a process of its own with a log of its own. Cases that are whole
/// already are left alone, steps that are whole are kept; one that fails stops no other. ok where all are
/// well, else quality_failed. Throws ResourceError where another batch is at work in the folder and this one
/// shall not wait.
ExitCode run_batch(const BatchCommand& options, const CommonOptions& common, const core::TaskContext& task);

/// Adds `run` and `batch`.
void define_run(CLI::App& app, RunCommand& chain, BatchCommand& batch, const CommonOptions& common,
                std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
