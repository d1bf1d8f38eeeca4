#pragma once
/// \file Files on their way to the disk.

#include <filesystem>

namespace ostia::core {

/// Asks the system to begin writing what a file holds to the disk, and waits for nothing: so that what syncs
/// it later finds most of it there. A hint: a file that is not there, or lies where this is not known, is no
/// error.
void begin_writing_back(const std::filesystem::path& path);

}  // namespace ostia::core
