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
  InputOptions input;  ///< CT, or a mask
  MaskOptions of_mask;
  std::filesystem::path output;  ///< case
  std::filesystem::path lines;   ///< centerlines; empty: none
  std::string axes;              ///< of the CT, in place of its file's; empty: its file's
  double least_confidence = 0.5;
  std::string vesselness = "flux";  ///< or "hessian"
  bool json = false;
};
ExitCode run_extract(const ExtractCommand& options, const core::TaskContext& task);

/// Adds what is said of a mask: --mask, --label, --image.
void add_mask(CLI::App& app, MaskOptions& options);
/// Adds `extract`.
void define_extract(CLI::App& app, ExtractCommand& extract,
                    std::function<ExitCode(const core::TaskContext&)>& run,
                    const std::function<void(CLI::App&, InputOptions&)>& add_dicom);

}  // namespace ostia::app
