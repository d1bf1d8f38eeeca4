#pragma once
/// \file Files that hold when they were made: whether the rest of two of them is the same.

#include <filesystem>
#include <string>

namespace ostia::cohort {

/// Cases (`.ostia`) and manifests (`manifest.json`).
bool holds_times(const std::string& name);

/// Of two such files. A case: all of its tables but the times of its steps. A manifest: all but times, memory
/// and the digests of what was read, which is compared by itself. False where one cannot be read.
bool same_but_for_times(const std::filesystem::path& one, const std::filesystem::path& other);

}  // namespace ostia::cohort
