#pragma once
/// \file What runs that were killed left behind.

#include <cstddef>
#include <filesystem>
#include <vector>

namespace ostia::core {

/// Hidden files and folders that were under construction (StagedFile, StagedFolder) in `folder` or at any
/// depth below it, and whose process is gone; links are not followed, what cannot be looked into is left out.
/// Sorted.
std::vector<std::filesystem::path> strays_below(const std::filesystem::path& folder);

/// Removes them as remove_dead_parts does, with the same bound: one that another process has locked stays.
/// Returns how many are gone.
std::size_t remove_strays(const std::vector<std::filesystem::path>& strays);

}  // namespace ostia::core
