#include "text.h"

#include "ostia/core/utf8.h"

#include <algorithm>

namespace ostia::pacs {
namespace {

constexpr std::size_t longest_text = 1024;

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  text = text.substr(0, longest_text);
  while (!text.empty()) {
    const std::size_t length = core::utf8_length(text);
    const auto first = static_cast<unsigned char>(text.front());
    if (length == 0)
      clean += '?';
    else if (length == 1)
      clean += first < 0x20 || first == 0x7F ? ' ' : text.front();
    else if (first == 0xC2 && static_cast<unsigned char>(text[1]) < 0xA0)
      clean += ' ';  // U+0080 to U+009F steer a terminal
    else
      clean += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  clean.erase(clean.find_last_not_of(' ') + 1);
  clean.erase(0, std::min(clean.find_first_not_of(' '), clean.size()));
  return clean;
}

std::string clean_name(std::string_view text) {
  while (!text.empty() && text.front() == '=') text.remove_prefix(1);
  std::string name = clean_text(text.substr(0, text.find('=')));
  name.erase(name.find_last_not_of('^') + 1);
  return name;
}

std::string hexadecimal(std::uint32_t number) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (int shift = number > 0xFFFF ? 28 : 12; shift >= 0; shift -= 4) text += digits[number >> shift & 15];
  return "0x" + text;
}

}  // namespace ostia::pacs
