#include "dicom_decode.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <charconv>
#include <string_view>

namespace ostia::imaging {
namespace {

constexpr std::string_view kDecodeMagic = "ostia decode 1\n";

}  // namespace

void write_decode_list(const std::filesystem::path& list_file, const std::vector<DecodeItem>& items) {
  std::string text(kDecodeMagic);
  for (const DecodeItem& item : items) {
    text += item.path.string() + '\0' + std::to_string(item.frame) + '\0';
  }
  core::write_file(list_file, text);
}

std::vector<DecodeItem> read_decode_list(const std::filesystem::path& list_file) {
  const std::string text = core::read_file(list_file, 1ULL << 30);
  if (!text.starts_with(kDecodeMagic))
    throw InvalidInput("'" + list_file.string() + "' is not a list of slices to decode");
  std::vector<DecodeItem> items;
  std::size_t at = kDecodeMagic.size();
  const auto next = [&]() {
    const std::size_t end = text.find('\0', at);
    if (end == std::string::npos) throw InvalidInput("'" + list_file.string() + "' is cut short");
    const std::string word = text.substr(at, end - at);
    at = end + 1;
    return word;
  };
  while (at < text.size()) {
    DecodeItem item;
    item.path = next();
    const std::string frame = next();
    const auto [end, error] = std::from_chars(frame.data(), frame.data() + frame.size(), item.frame);
    if (error != std::errc() || end != frame.data() + frame.size() || item.frame < 0) {
      throw InvalidInput("'" + list_file.string() + "': frame '" + frame + "' is no number");
    }
    items.push_back(std::move(item));
  }
  return items;
}

}  // namespace ostia::imaging
