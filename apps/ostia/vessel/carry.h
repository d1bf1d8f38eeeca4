#pragma once
/// \file `ostia carry`: what it is told.

#include "commands.h"

#include "ostia/session/carry.h"

#include <filesystem>
#include <functional>

namespace CLI {
class App;
}

namespace ostia::app {

struct CarryCommand {
  std::filesystem::path before;        ///< case
  std::filesystem::path before_image;  ///< the CT that it was made with
  InputOptions after;                  ///< the later CT
  std::filesystem::path output;        ///< case
  session::CarryOptions options;
  bool json = false;
};
ExitCode run_carry(const CarryCommand& options, const core::TaskContext& task);

/// Adds `carry`.
void define_carry(CLI::App& app, CarryCommand& carry, std::function<ExitCode(const core::TaskContext&)>& run,
                  const std::function<void(CLI::App&, InputOptions&)>& add_dicom);

}  // namespace ostia::app
