#include "dicom_shown.h"

#include "dicom_attributes.h"
#include "dicom_parser.h"

#include "ostia/core/utf8.h"
#include "ostia/imaging/dicom_dataset.h"

#include <algorithm>

namespace ostia::imaging {
namespace {

constexpr std::uint32_t kCharacterSet = dicom_tag(0x0008, 0x0005), kStudyDate = dicom_tag(0x0008, 0x0020),
                        kShownSeries = dicom_tag(0x0008, 0x103E), kPatientName = dicom_tag(0x0010, 0x0010),
                        kShownPatientId = dicom_tag(0x0010, 0x0020);
constexpr std::size_t kLongest = 256;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

template <class TextOf>
ShownIdentity shown_of(const TextOf& text_of) {
  const std::string set = text_of(kCharacterSet);
  ShownIdentity shown;
  shown.patient_name = shown_name(text_of(kPatientName), set);
  shown.patient_id = shown_text(text_of(kShownPatientId), set);
  shown.study_date = shown_date(text_of(kStudyDate));
  shown.series_description = shown_text(text_of(kShownSeries), set);
  return shown;
}

}  // namespace

std::string shown_text(std::string_view bytes, std::string_view character_set) {
  const bool latin = character_set.find("ISO_IR 100") != std::string_view::npos ||
                     character_set.find("ISO 2022 IR 100") != std::string_view::npos;
  const bool utf8 = character_set.find("ISO_IR 192") != std::string_view::npos;
  bytes = bytes.substr(0, kLongest);
  std::string result;
  for (std::size_t i = 0; i < bytes.size();) {
    const auto c = static_cast<unsigned char>(bytes[i]);
    std::size_t used = 1;
    if (c < 0x20 || c == 0x7F) {
      result += ' ';
    } else if (c < 0x80) {
      result += bytes[i];
    } else if (const std::size_t length = utf8 ? core::utf8_length(bytes.substr(i)) : 0; length > 0) {
      used = length;
      result += bytes.substr(i, used);
    } else if (latin && c >= 0xA0) {
      result += static_cast<char>(0xC0 | c >> 6);
      result += static_cast<char>(0x80 | (c & 0x3F));
    } else {
      result += '?';
    }
    i += used;
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  result.erase(0, std::min(result.find_first_not_of(' '), result.size()));
  return result;
}

std::string shown_name(std::string_view bytes, std::string_view character_set) {
  const std::string text = shown_text(bytes.substr(0, bytes.find('=')), character_set);
  std::string family = text.substr(0, text.find('^'));
  std::string given;
  if (family.size() < text.size()) given = text.substr(family.size() + 1);
  std::replace(given.begin(), given.end(), '^', ' ');
  while (!given.empty() && given.back() == ' ') given.pop_back();
  if (given.empty()) return family;
  return family.empty() ? given : family + ", " + given;
}

std::string shown_date(std::string_view text) {
  std::string digits;
  for (const char c : text) {
    if (is_digit(c)) {
      digits += c;
    } else if (c != '.' && c != ' ') {
      return {};
    }
  }
  if (digits.size() != 8) return {};
  return digits.substr(0, 4) + "-" + digits.substr(4, 2) + "-" + digits.substr(6, 2);
}

ShownIdentity shown_identity(const std::filesystem::path& dicom_file) {
  DicomTexts texts{
      {kCharacterSet, {}}, {kStudyDate, {}}, {kShownSeries, {}}, {kPatientName, {}}, {kShownPatientId, {}}};
  if (!read_dicom_texts(dicom_file, texts)) return {};
  return shown_of([&](DicomTag tag) { return texts[tag]; });
}

ShownIdentity shown_identity(const DicomDataset& data) {
  return shown_of([&](DicomTag tag) { return data.text(tag); });
}

ShownIdentity shown_identity(const DicomSeries& series) {
  if (series.files.empty()) return {};
  ShownIdentity shown = shown_identity(series.files[series.files.size() / 2]);
  shown.slices = static_cast<std::int64_t>(series.files.size());
  return shown;
}

}  // namespace ostia::imaging
