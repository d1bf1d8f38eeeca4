#pragma once
/// \file The runs of the pressure experiment as files.

#include "ostia/experiments/pressure.h"

#include <filesystem>
#include <optional>
#include <string>

namespace ostia::experiments {

/// Pressures to 0.01 Pa, abscissas to a micrometre, flows to 1e-7 ml/s: a few kB.
std::string run_json(const PressureRun& run);
/// Throws InvalidInput that names the file.
PressureRun run_of_json(const std::string& text, const std::filesystem::path& file);

/// plan.json, and for each run CASE.json with all that the comparison needs. What else a run leaves is in a
/// folder CASE.
class PressureKeep {
 public:
  /// Throws InvalidInput for runs of another plan, IoError.
  explicit PressureKeep(const PressureOptions& options);
  /// What is kept of a task; nothing where it was of other input.
  std::optional<PressureRun> find(const std::string& id, const std::string& digest) const;
  /// Of a run's own, made if it is not there.
  std::filesystem::path folder_of(const std::string& id) const;
  void put(const std::string& id, const PressureRun& run) const;
  /// Removes the folder of a run that was not brought to its end.
  void drop(const std::string& id) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace ostia::experiments
