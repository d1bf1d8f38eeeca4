#pragma once
/// \file `ostia fat`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace ostia::app {

struct FatCommand {
  std::filesystem::path input;    ///< case
  std::filesystem::path image;    ///< the CT that the case was made with
  std::filesystem::path output;   ///< folder that is made
  std::optional<double> tube_kv;  ///< in place of what the DICOM files say
  bool json = false;
};
ExitCode run_fat(const FatCommand& options, const core::TaskContext& task);

/// Adds `fat`.
void define_fat(CLI::App& app, FatCommand& fat, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
