#pragma once
/// \file `ostia territories`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct TerritoriesCommand {
  std::filesystem::path input;       ///< case, or a tree of lines
  std::filesystem::path myocardium;  ///< mask of the left ventricle's muscle
  int label = 0;                     ///< of the mask that is muscle; 0: all but 0
  std::filesystem::path output;      ///< folder that is made
  std::vector<std::string> behind;   ///< "LAD:24"
  bool json = false;
};
ExitCode run_territories(const TerritoriesCommand& options, const core::TaskContext& task);

/// Adds `territories`.
void define_territories(CLI::App& app, TerritoriesCommand& territories,
                        std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
