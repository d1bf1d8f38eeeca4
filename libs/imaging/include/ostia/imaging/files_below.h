#pragma once
/// \file The files of a folder that somebody names.

#include <filesystem>
#include <vector>

namespace ostia::imaging {

/// Regular files below a folder (32 folders deep at most) or, not `recursive`, in it, by name; folders that
/// may not be read are passed over. Throws IoError where the folder itself cannot be read or the walk breaks
/// off, InvalidInput for more than 200,000 files.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder, bool recursive = true);

}  // namespace ostia::imaging
