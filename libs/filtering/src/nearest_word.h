#pragma once
/// \file What somebody may have meant. Private to the room.

#include <string>
#include <string_view>
#include <vector>

namespace ostia::filtering::detail {

/// The word that the fewest insertions, deletions and replacements of letters make of `given` (Levenshtein);
/// of several the first. Empty where there are none.
std::string nearest_word(std::string_view given, const std::vector<std::string>& words);

}  // namespace ostia::filtering::detail
