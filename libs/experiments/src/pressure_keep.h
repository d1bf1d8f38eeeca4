#pragma once
/// \file The runs of the pressure experiment as files.

#include "ostia/experiments/pressure.h"

#include <filesystem>
#include <optional>
#include <string>

namespace ostia::experiments {

std::string run_json(const PressureRun& run);
/// Throws InvalidInput that names the file.
PressureRun run_of_json(const std::string& text, const std::filesystem::path& file);

/// plan.json and a folder a run with its run.json.
class PressureKeep {
 public:
  /// Throws InvalidInput for runs of another plan, IoError.
  explicit PressureKeep(const PressureOptions& options);
  /// What is kept of a task; nothing where it was of other input.
  std::optional<PressureRun> find(const std::string& id, const std::string& digest) const;
  /// Of its own, made if it is not there.
  std::filesystem::path folder_of(const std::string& id) const;
  void put(const std::string& id, const PressureRun& run) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace ostia::experiments
