#include "dicom_element.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace ostia::imaging {
namespace {

bool upper_case(char c) {
  return c >= 'A' && c <= 'Z';
}

/// Without a preamble: a first element of group 0002 or 0008 that makes sense.
bool looks_like_data_set(DicomSource& source, DicomEncoding& encoding) {
  unsigned char b[8];
  if (!source.read(0, b, sizeof b)) return false;
  const bool little = (b[0] == 0x02 || b[0] == 0x08) && b[1] == 0x00;
  const bool big = b[0] == 0x00 && b[1] == 0x08;
  if (!little && !big) return false;
  encoding.big_endian = big;
  encoding.explicit_vr = upper_case(static_cast<char>(b[4])) && upper_case(static_cast<char>(b[5]));
  if (encoding.explicit_vr) return true;
  const std::uint32_t length =
      big ? static_cast<std::uint32_t>(b[6]) << 8 | b[7] : static_cast<std::uint32_t>(b[5]) << 8 | b[4];
  const bool high_zero = big ? (b[4] == 0 && b[5] == 0) : (b[6] == 0 && b[7] == 0);
  return high_zero && length <= 1024 && length <= source.size();
}

}  // namespace

bool dicom_long_length(const char* vr) {
  static constexpr char kLong[][3] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                      "SV", "UC", "UN", "UR", "UT", "UV"};
  return std::any_of(std::begin(kLong), std::end(kLong),
                     [&](const char* v) { return v[0] == vr[0] && v[1] == vr[1]; });
}

std::uint32_t DicomHeadReader::u16(std::uint64_t offset, bool big) {
  unsigned char b[2];
  need(offset, b, 2);
  return big ? static_cast<std::uint32_t>(b[0]) << 8 | b[1] : static_cast<std::uint32_t>(b[1]) << 8 | b[0];
}

std::uint32_t DicomHeadReader::u32(std::uint64_t offset, bool big) {
  const std::uint32_t first = u16(offset, big), second = u16(offset + 2, big);
  return big ? first << 16 | second : second << 16 | first;
}

DicomElementHead DicomHeadReader::element(std::uint64_t offset, DicomEncoding encoding) {
  DicomElementHead e;
  e.tag = tag_at(offset, encoding.big_endian);
  e.value = offset + 8;
  if (e.tag >> 16 == 0xFFFE || !encoding.explicit_vr) {
    e.length = u32(offset + 4, encoding.big_endian);
    return e;
  }
  char vr[2];
  need(offset + 4, vr, 2);
  if (!upper_case(vr[0]) || !upper_case(vr[1])) {
    // Some writers slip elements without a VR into an explicit data set.
    e.length = u32(offset + 4, encoding.big_endian);
    return e;
  }
  e.vr[0] = vr[0];
  e.vr[1] = vr[1];
  if (dicom_long_length(vr)) {
    e.length = u32(offset + 8, encoding.big_endian);
    e.value = offset + 12;
  } else {
    e.length = u16(offset + 6, encoding.big_endian);
  }
  return e;
}

void DicomHeadReader::need(std::uint64_t offset, void* to, std::size_t count) {
  if (source_.read(offset, to, count)) return;
  throw DicomDamage{"the file ends at byte " + std::to_string(source_.size()) +
                    " in the middle of an element"};
}

void DicomHeadReader::check_length(const DicomElementHead& e, std::uint64_t end) {
  if (e.length <= end && e.value <= end - e.length) return;
  const std::uint64_t left = end > e.value ? end - e.value : 0;
  throw DicomDamage{"element " + tag_name(e.tag) + " is said to have " + std::to_string(e.length) +
                    " bytes, but " + std::to_string(left) + " are left"};
}

DicomEncoding detected_encoding(DicomSource& source, std::uint64_t offset, DicomEncoding declared) {
  char b[8];
  if (!source.read(offset, b, sizeof b)) return declared;
  return {upper_case(b[4]) && upper_case(b[5]), declared.big_endian};
}

std::optional<DicomStart> dicom_start(DicomSource& source) {
  char magic[4] = {0, 0, 0, 0};
  DicomStart start;
  if (source.read(128, magic, 4) && std::memcmp(magic, "DICM", 4) == 0) {
    start.offset = 132;
    start.preamble = true;
  } else if (!looks_like_data_set(source, start.encoding)) {
    return std::nullopt;
  }
  char group[2] = {0, 0};
  start.has_meta = source.read(start.offset, group, 2) && group[0] == 2 && group[1] == 0;
  if (start.preamble && !start.has_meta && source.read(start.offset, group, 2)) {
    char b[6] = {0, 0, 0, 0, 0, 0};
    source.read(start.offset, b, sizeof b);
    start.encoding.big_endian = b[0] == 0 && b[1] != 0;
    start.encoding.explicit_vr = upper_case(b[4]) && upper_case(b[5]);
  }
  return start;
}

}  // namespace ostia::imaging
