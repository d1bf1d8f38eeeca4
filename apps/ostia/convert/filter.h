#pragma once
/// \file `ostia filter`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct FilterCommand {
  InputOptions input;
  std::filesystem::path output;
  std::vector<std::string> with;  ///< "n4:iterations=50"
  std::filesystem::path mask, reference;
  std::string type = "auto";  ///< auto, int16, uint8, float32
  bool list = false, json = false;
};
ExitCode run_filter(const FilterCommand& options, const core::TaskContext& task);

/// Adds `filter`.
void define_filter(CLI::App& app, FilterCommand& filter,
                   std::function<ExitCode(const core::TaskContext&)>& run,
                   const std::function<void(CLI::App&, InputOptions&)>& add_dicom);

}  // namespace ostia::app
