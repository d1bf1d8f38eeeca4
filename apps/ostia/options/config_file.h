#pragma once
/// \file Options from a JSON file.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::app {

/// The arguments with those of `--config FILE` put in: each member of the JSON object is a long option
/// without its dashes; true is a flag, an array repeats the option. What stands on the command line wins.
/// Throws InvalidInput naming the file and the member.
std::vector<std::string> with_config(std::vector<std::string> arguments);

}  // namespace ostia::app
