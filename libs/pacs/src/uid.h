#pragma once
// What may be taken for a DICOM unique identifier, from whoever says so.

#include <algorithm>
#include <string_view>

namespace ostia::pacs {

/// Digits and points, 64 at most (PS3.5 9.1): safe as a file's name and in an URL.
inline bool is_uid(std::string_view text) {
  return !text.empty() && text.size() <= 64 && text.front() != '.' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
}

}  // namespace ostia::pacs
