#pragma once
/// \file What a crate of `write_crate` tells of some of its scans.

#include "ostia/cohort/cohort.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ostia::cohort {

struct RecordedStep {
  std::string chain;                         ///< its file, from the crate's folder on
  std::set<std::string> read;                ///< digests
  std::map<std::string, std::string> files;  ///< of its result, from the stage's folder on: digests
};

struct RecordedScan {
  std::string pseudonym;
  std::array<std::optional<RecordedStep>, stages.size()> steps;
};

struct RecordedCrate {
  std::vector<RecordedScan> scans;             ///< `only` of those that have a result, evenly spaced
  std::map<std::string, std::string> digests;  ///< of the workflow's files
  std::set<std::string> programs;              ///< versions of Ostia
};

/// Reads entity by entity: memory does not grow with the scans that are not taken. Throws InvalidInput.
RecordedCrate read_crate(const std::filesystem::path& folder, std::size_t only);

}  // namespace ostia::cohort
