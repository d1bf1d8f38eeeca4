#pragma once
/// \file `ostia lumen` and `ostia replay`: what they are told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct LumenModelCommand {
  std::filesystem::path input;   ///< case, or centerlines
  std::filesystem::path output;  ///< the surface
  std::filesystem::path edits;
  std::string start;  ///< tube, image, surface, contours; empty: by what is given
  std::filesystem::path image, surface, contours;
  std::string observer;              ///< whose contours; empty: the only observer's
  std::string vessel;                ///< name of a line from a Rotterdam file
  std::optional<double> radius_mm;   ///< of a tube; none: the centerlines' radii
  std::optional<double> spacing_mm;  ///< of samples
  std::string kernel;                ///< empty: the library's default
  double cell_mm = 0.0;              ///< of the surface's grid; 0: by the smallest radius
  std::filesystem::path case_output, lines_output;
  bool json = false;
};
ExitCode run_lumen(const LumenModelCommand& options, const core::TaskContext& task);

struct ReplayCommand {
  std::filesystem::path input;   ///< case or journal
  std::filesystem::path start;   ///< the case that a journal starts from; empty: the one beside it
  std::filesystem::path output;  ///< a case, or a journal
  bool json = false;
};
ExitCode run_replay(const ReplayCommand& options, const core::TaskContext& task);

/// Adds `lumen` and `replay`.
void define_lumen(CLI::App& app, LumenModelCommand& lumen, ReplayCommand& replay,
                  std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
