#pragma once
/// \file Which Ostia this is.

#include <string>

namespace ostia::core {

/// Version of the libraries and of the programs linked with them, "major.minor.patch"
/// (docs/reference/installing.md tells what its parts promise). It stands in the CMakeLists.txt at the root
/// alone.
std::string version();

}  // namespace ostia::core
