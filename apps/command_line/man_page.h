#pragma once
/// \file Manual pages (man 1) from the descriptions that --help prints, too.

#include "command_description.h"

#include <string>

namespace ostia::command_line {

/// Of `command`, which is `program` or one of the commands below it: troff with the macros of man(7).
std::string man_page(const CommandDescription& command, const CommandDescription& program);

}  // namespace ostia::command_line
