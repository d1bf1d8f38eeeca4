#pragma once
// Texts from the network.

#include <cstdint>
#include <string>
#include <string_view>

namespace ostia::pacs {

/// Sound UTF-8 without control characters and blanks at the ends: what is none becomes '?'. At most 1024
/// bytes.
std::string clean_text(std::string_view text);
/// The alphabetic part of a person's name (PS3.5 6.2.1), or the first part there is.
std::string clean_name(std::string_view text);
/// "0xA700".
std::string hexadecimal(std::uint32_t number);

}  // namespace ostia::pacs
