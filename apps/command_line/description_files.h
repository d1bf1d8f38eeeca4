#pragma once
/// \file What a program writes about itself when it is built, to be installed beside it.

#include "command_description.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::command_line {

/// The folder of `--describe FOLDER`, where this is all that `arguments` (without the program's name) have.
/// The option is for the build: help does not name it.
std::optional<std::filesystem::path> described_into(const std::vector<std::string>& arguments);

/// Manual pages (man/man1/*.1, one for each command) and completions for bash and zsh, as folders of `share`
/// have them, and all that a CommandDescription holds as PROGRAM-commands.json. Throws IoError.
void write_description_files(const CommandDescription& program, const std::filesystem::path& folder);

}  // namespace ostia::command_line
