#pragma once
/// \file `ostia reconstruct`: what it is told.

#include "commands.h"

#include "ostia/reconstruction/hexahedra.h"
#include "ostia/reconstruction/surface.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace ostia::app {

struct ReconstructCommand {
  InputOptions input;
  TreeInputOptions tree;
  std::filesystem::path output;
  std::filesystem::path wall;  ///< empty: circles of the tree's radii
  reconstruction::ReconstructionOptions options;
  std::optional<int> sides;         ///< nothing: the library's default
  std::filesystem::path hexahedra;  ///< empty: none
  reconstruction::HexahedraOptions sweep;
  bool frusta = false;  ///< truncated cones instead
  bool json = false;
};
/// quality_failed where vessels still run through each other: the surface is there, and is not closed.
ExitCode run_reconstruct(const ReconstructCommand& command, const core::TaskContext& task);

/// Adds `reconstruct`.
void define_reconstruct(CLI::App& app, ReconstructCommand& command,
                        std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
