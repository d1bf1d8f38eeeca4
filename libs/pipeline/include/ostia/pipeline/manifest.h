#pragma once
/// \file The manifest that makes a folder whole: what was done, with what, and what came out.

#include "ostia/core/error.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ostia::pipeline {

/// What decides whether a job was done already.
struct JobKey {
  std::string command;
  std::map<std::string, std::string> inputs;  ///< role -> SHA-256
  std::string parameters;                     ///< canonical JSON text
};

struct ManifestRecord {
  JobKey key;
  ExitCode exit_code = ExitCode::ok;
  double seconds = 0.0;
  std::vector<std::string> warnings;
  std::string quality;   ///< JSON text of the job's figures
  double peak_mb = 0.0;  ///< of runs before this process, which counts by itself
};

/// Writes `manifest.json` into the folder, last: program and library versions, times, peak memory, warnings
/// (the record's, and those that a living core::HeardWarnings has heard), SHA-256 of every file there.
void write_manifest(const std::filesystem::path& folder, const ManifestRecord& record);

/// The recorded exit code when the folder is whole and holds this very job done by this program version;
/// nothing otherwise.
std::optional<ExitCode> already_done(const std::filesystem::path& folder, const JobKey& key);

/// Before any work: throws IoError when a folder cannot be made at `folder`, InvalidInput when one is there
/// that holds anything but the files of an earlier job (it would be replaced as a whole).
void require_free_folder(const std::filesystem::path& folder);

/// The manifest's text; empty where there is none.
std::string manifest_of(const std::filesystem::path& folder);

/// Most memory resident, of this process or of one of its children that have ended, MB.
double peak_memory_mb();

}  // namespace ostia::pipeline
