#pragma once
/// \file What of a command line may name a person, so that a log that is kept leaves it out.

#include "command_description.h"

#include <string>
#include <string_view>
#include <vector>

namespace ostia::command_line {

struct PrivateWord {
  std::string text, alias;
};

/// All that was given but the program's own words (commands, options, choices) and numbers, whatever option
/// it was given to: an option cannot be forgotten. Of a path, and of each part of a list ("a=b", "a,b",
/// "a:b"), also its folder, its name, and what its name is without an ending. The alias is the option's name,
/// "OUTPUT".
std::vector<PrivateWord> private_words(const CommandDescription& program,
                                       const std::vector<std::string>& arguments);

/// The last value that an option has in `arguments`, "--log json" or "--log=json"; empty where it has none.
std::string value_of(std::string_view option, const std::vector<std::string>& arguments);

}  // namespace ostia::command_line
