#pragma once
/// \file `ostia calcium`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct CalciumCommand {
  InputOptions input;                 ///< CT without contrast agent
  std::filesystem::path output;       ///< folder that is made
  std::vector<std::string> assign;    ///< "3:LAD"
  std::optional<double> calibration;  ///< mg/cm3 for each HU
  std::string slices = "3mm";         ///< or "as-scanned"
  bool json = false;
};
ExitCode run_calcium(const CalciumCommand& options, const core::TaskContext& task);

/// Adds `calcium`.
void define_calcium(CLI::App& app, CalciumCommand& calcium,
                    std::function<ExitCode(const core::TaskContext&)>& run,
                    const std::function<void(CLI::App&, InputOptions&)>& add_dicom);

}  // namespace ostia::app
