#pragma once
/// \file `ostia grow`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct GrowCommand {
  std::filesystem::path input, output;  ///< trees
  std::filesystem::path domain;         ///< closed surface; empty: a shell about the tree
  std::string artery = "lad";           ///< rca, lad, lcx
  double wall_mm = 12.0;                ///< of the shell
  std::int64_t most_segments = 20'000'000;
  bool json = false;
};
ExitCode run_grow(const GrowCommand& options, std::uint64_t seed, const core::TaskContext& task);

/// Adds `grow`.
void define_grow(CLI::App& app, GrowCommand& grow, const std::uint64_t& seed,
                 std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
