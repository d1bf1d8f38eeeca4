#pragma once
/// \file `ostia report`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct ReportCommand {
  std::filesystem::path input;   ///< case
  std::filesystem::path image;   ///< the CT that the case was made with; empty: no image
  std::filesystem::path output;  ///< folder that is made
  std::string date;              ///< as it is to stand in the report; empty: none
  double theta_deg = 0.0;
  double level_hu = 250.0, window_hu = 900.0;
  std::string language = "en";       ///< of what a person reads
  std::string form = "full";         ///< "full" or "short"
  std::filesystem::path calcium;     ///< JSON with an Agatston score; empty: none
  std::filesystem::path impression;  ///< text in place of the case's own or the draft; empty: none
  std::string signer, changes;       ///< who signs it, and what changed since the last version
  bool json = false;
};
ExitCode run_report(const ReportCommand& options, const core::TaskContext& task);

/// Adds `report`.
void define_report(CLI::App& app, ReportCommand& report,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
