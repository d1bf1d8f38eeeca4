#pragma once
/// \file `ostia measure`: what it is told.

#include "commands.h"

#include <filesystem>

namespace ostia::app {

struct MeasureCommand {
  InputOptions input;  ///< tree of vessels, case or surface
  EndOptions ends;     ///< of a surface
  std::filesystem::path output;
  bool json = false;
};
ExitCode run_measure(const MeasureCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
