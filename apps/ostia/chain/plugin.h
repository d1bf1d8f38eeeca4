#pragma once
/// \file `ostia plugin`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct PluginCommand {
  std::string name;
  std::filesystem::path input;      ///< case, or the image where the plug-in gives a mask
  std::filesystem::path image;      ///< beside a case: the CT that it was made with; empty: none
  std::filesystem::path output;     ///< case, surface, or image, by what the plug-in gives
  std::vector<std::string> values;  ///< "name=value"
  int time_limit_s = 3600;
  bool json = false;
};
ExitCode run_plugin_list(const PluginCommand& options, const core::TaskContext& task);
/// Nothing is written where the plug-in fails or one of its edits is refused.
ExitCode run_plugin(const PluginCommand& options, const core::TaskContext& task);

/// Adds `plugin list` and `plugin run`.
void define_plugin(CLI::App& app, PluginCommand& plugin,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
