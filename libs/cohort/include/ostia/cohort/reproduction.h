#pragma once
/// \file Some scans of a crate done once more, and held against what is recorded of them.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace ostia::cohort {

enum class FileVerdict {
  same,           ///< bit by bit
  but_for_times,  ///< a case or a manifest, which hold when they were made: the rest is the same
  differs,
  missing,       ///< its step has no result now, or has none of this name
  not_compared,  ///< its step was not done again; or it may differ by times, and the crate does not hold it
};
inline constexpr std::size_t file_verdict_count = 5;
std::string name_of(FileVerdict verdict);

struct ReproducedFile {
  std::string scan, stage, file;
  std::string recorded, found;  ///< SHA-256; `found` is empty where there is none
  FileVerdict verdict = FileVerdict::same;
};

struct ReproductionOptions {
  std::filesystem::path crate;           ///< a folder with ro-crate-metadata.json and workflow/
  std::filesystem::path private_folder;  ///< empty: beside the crate, where it is; without it scans begin
                                         ///< with what was imported, which the crate must hold
  std::filesystem::path output;          ///< folder that is made
  std::size_t only = 0;                  ///< so many scans, evenly spaced over all; 0: all
};

/// Runs a chain (`ostia run`) into a folder, with values of variables. Hands back the exit code.
using ChainRun = std::function<int(const std::filesystem::path& chain, const std::filesystem::path& folder,
                                   const std::vector<std::pair<std::string, std::string>>& values)>;

struct Reproduction {
  std::size_t scans = 0, steps = 0;   ///< that were done again
  std::vector<std::string> programs;  ///< versions that made what is recorded
  std::vector<ReproducedFile> files;
  std::size_t count(FileVerdict verdict) const;
  /// Nothing differs or is missing.
  bool is_same() const;
};

/// Does the recorded steps with a result again, by the crate's own chains. A case that a person has corrected
/// is taken from the crate by what follows it. The folder `output` has what was made, in a cohort's layout,
/// `files.csv` (a row a file) and a manifest. Throws InvalidInput: no crate, one of another kind, a chain
/// that is not the one that is recorded, a scan whose origin is not at hand; `output` holds other things;
/// ResourceError, Cancelled.
Reproduction reproduce(const ReproductionOptions& options, const ChainRun& run,
                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
