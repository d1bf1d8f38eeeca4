#pragma once
/// \file `ostia extract`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct ExtractCommand {
  InputOptions input;            ///< CT, or a mask
  std::filesystem::path image;   ///< the CT of a mask; empty: none
  bool mask = false;             ///< the input is a mask, whatever its values look like
  std::vector<int> labels;       ///< of a mask that are vessels; empty: all but 0
  std::filesystem::path output;  ///< case
  std::filesystem::path lines;   ///< centerlines; empty: none
  double least_confidence = 0.5;
  std::string vesselness = "flux";  ///< or "hessian"
  bool json = false;
};
ExitCode run_extract(const ExtractCommand& options, const core::TaskContext& task);

/// Adds `extract`.
void define_extract(CLI::App& app, ExtractCommand& extract,
                    std::function<ExitCode(const core::TaskContext&)>& run,
                    const std::function<void(CLI::App&, InputOptions&)>& add_dicom);

}  // namespace ostia::app
