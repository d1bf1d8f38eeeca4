#pragma once
/// \file Files and folders in the programs that the desktop has for them.

#include <filesystem>

namespace ostia::workstation {

struct Desk;

/// Says so where there is no such program, or it fails to start: at once, or as soon as the desktop tells.
void open_with_desktop(const Desk& desk, const std::filesystem::path& path);

}  // namespace ostia::workstation
