#pragma once
/// \file `ostia compare`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct CompareCommand {
  std::filesystem::path before, after;              ///< cases
  std::filesystem::path before_image, after_image;  ///< the CTs that they were made with; empty: no plaque
  std::filesystem::path pairs;          ///< table of pairs, in place of all those; empty: one pair
  std::filesystem::path repeatability;  ///< cohort.json; empty: none
  std::filesystem::path output;         ///< folder that is made
  std::string map = "any";              ///< session::map_by
  bool anyway = false;
  bool json = false;
};
ExitCode run_compare(const CompareCommand& options, const core::TaskContext& task);

/// Adds `compare`.
void define_compare(CLI::App& app, CompareCommand& compare,
                    std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
