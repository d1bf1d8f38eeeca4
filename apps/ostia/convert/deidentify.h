#pragma once
/// \file `ostia deidentify`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct DeidentifyCommand {
  std::filesystem::path input, output;
  std::string patient = "ANONYMOUS";
  bool json = false;
};
ExitCode run_deidentify(const DeidentifyCommand& options, const core::TaskContext& task);

/// Adds `deidentify`.
void define_deidentify(CLI::App& app, DeidentifyCommand& deidentify,
                       std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
