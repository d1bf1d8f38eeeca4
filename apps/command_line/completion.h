#pragma once
/// \file Completion of command lines in shells: commands, options, the words that an option takes, files.

#include "command_description.h"

#include <string>

namespace ostia::command_line {

/// A script that bash reads for the program of this name.
std::string bash_completion(const CommandDescription& program);

/// A function that zsh loads for it.
std::string zsh_completion(const CommandDescription& program);

}  // namespace ostia::command_line
