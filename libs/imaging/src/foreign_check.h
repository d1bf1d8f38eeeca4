#pragma once
/// \file Whether a file holds the voxels that its header speaks of: ITK's readers fill what is missing with
/// whatever lay in memory. Private to the room.

#include <cstdint>
#include <filesystem>
#include <string>

namespace ostia::imaging {

/// `bytes`: of all voxels as ITK gives them. Throws InvalidInput ("it is cut short: ...").
void require_complete(const std::filesystem::path& path, const std::string& format, std::uint64_t voxels,
                      std::uint64_t bytes);

}  // namespace ostia::imaging
