#pragma once
/// \file The Python that plug-ins run in.

#include "ostia/core/task_context.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::session {

struct PluginPython {
  std::filesystem::path program;  ///< $OSTIA_PYTHON, the system's, or the first on the path
  std::filesystem::path package;  ///< the folder that `ostia` lies in
};

/// Throws IoError with the way out where one of the two is not there.
PluginPython plugin_python();

/// Runs it with these words until it ends, for at most `limit`. Progress comes from the file `progress` in
/// `folder` (fraction, stage). Returns what it said. Throws ResourceError out of time, Cancelled.
struct PythonRun {
  std::string said;
  std::string ended;  ///< empty: well
};
PythonRun run_python(const PluginPython& python, const std::vector<std::string>& words,
                     std::chrono::seconds limit, const std::filesystem::path& folder,
                     const core::TaskContext& task);

}  // namespace ostia::session
