#pragma once
/// \file `ostia doctor`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct DoctorCommand {
  std::vector<std::filesystem::path> paths;
  bool mend = false, json = false;
};
ExitCode run_doctor(const DoctorCommand& options, const core::TaskContext& task);

/// Adds `doctor`.
void define_doctor(CLI::App& app, DoctorCommand& doctor,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
