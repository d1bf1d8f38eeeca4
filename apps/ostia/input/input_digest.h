#pragma once
/// \file What a job was given, by content: whether it was done already.

#include <filesystem>
#include <string>

namespace ostia::app {

/// SHA-256 of a file, or of all files in a folder with their names (an OpenFOAM case, say). A header's data
/// files count with it: those beside it that have its name before .raw, .zraw, .gz and .bz2 (.mhd .nhdr), all
/// .h5 and .xdmf of the folder (.xdmf). Throws IoError.
std::string digest_of(const std::filesystem::path& input);

}  // namespace ostia::app
