#include "ostia/core/utf8.h"

namespace ostia::core {

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t n = 1; n < length; ++n)
    if ((byte(n) & 0xC0U) != 0x80U) return 0;
  const unsigned second = byte(1);
  const bool sound = first == 0xE0   ? second >= 0xA0
                     : first == 0xED ? second < 0xA0
                     : first == 0xF0 ? second >= 0x90
                     : first == 0xF4 ? second < 0x90
                                     : true;
  return sound ? length : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace ostia::core
