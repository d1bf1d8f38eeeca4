#pragma once
/// \file Which bytes are UTF-8 (RFC 3629).

#include <cstddef>
#include <string_view>

namespace ostia::core {

/// Bytes of the well-formed character that `text` begins with, 1 to 4; 0 where there is none: an empty text,
/// one cut short, a form longer than needed, half of a surrogate pair, a code beyond U+10FFFF.
std::size_t utf8_length(std::string_view text);
/// All of it is well-formed.
bool is_utf8(std::string_view text);

}  // namespace ostia::core
