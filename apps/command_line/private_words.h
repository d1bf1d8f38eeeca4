#pragma once
/// \file What of a command line may name a person, so that a log that is kept leaves it out.

#include "command_description.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::command_line {

struct PrivateWord {
  std::string text, alias;
};

/// The words of lower-case letters that the program's help is written with: "mesh", "out", "surface". They
/// name nobody, and its messages are made of them.
std::set<std::string> ordinary_words(const CommandDescription& program);

/// All that was given but the program's own words (commands, options, choices), ordinary ones and numbers,
/// whatever option it was given to: an option cannot be forgotten. Of a path, and of each part of a list
/// ("a=b", "a,b", "a:b"), also its folder, its name, and what its name is without an ending. The alias is the
/// option's name, "OUTPUT".
std::vector<PrivateWord> private_words(const CommandDescription& program,
                                       const std::vector<std::string>& arguments);

/// Of these the paths alone, as messages have them: what has a folder in front or lies there, whole and by
/// its own name. `exists` says what lies there.
std::vector<PrivateWord> private_paths(const CommandDescription& program,
                                       const std::vector<std::string>& arguments,
                                       const std::function<bool(const std::string&)>& exists);

/// The last value that an option has in `arguments`, "--log json" or "--log=json"; empty where it has none.
std::string value_of(std::string_view option, const std::vector<std::string>& arguments);

}  // namespace ostia::command_line
