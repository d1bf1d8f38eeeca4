#pragma once
/// \file Heads of DICOM elements and where a data set begins: what both of our parsers read by (PS3.5 7,
/// PS3.10 7).

#include "dicom_attributes.h"
#include "dicom_source.h"

#include <cstdint>
#include <optional>

namespace ostia::imaging {

inline constexpr std::uint32_t dicom_undefined_length = 0xFFFFFFFFu;
inline constexpr std::uint32_t dicom_item = 0xFFFEE000u, dicom_item_end = 0xFFFEE00Du,
                               dicom_sequence_end = 0xFFFEE0DDu, dicom_pixel_data = 0x7FE00010u;
inline constexpr std::uint64_t most_inflated_dicom_bytes = 2ULL << 30;

struct DicomEncoding {
  bool explicit_vr = true;
  bool big_endian = false;
};

struct DicomElementHead {
  std::uint32_t tag = 0;
  char vr[2] = {0, 0};  ///< zero where it is implicit
  std::uint32_t length = 0;
  std::uint64_t value = 0;  ///< offset
  bool is(const char* text) const { return vr[0] == text[0] && vr[1] == text[1]; }
};

/// Whether a VR has its length in four bytes where it is explicit.
bool dicom_long_length(const char* vr);

/// Reads heads of elements; every read is checked. Throws DicomDamage.
class DicomHeadReader {
 public:
  explicit DicomHeadReader(DicomSource& source) : source_(source) {}

  std::uint32_t u16(std::uint64_t offset, bool big);
  std::uint32_t u32(std::uint64_t offset, bool big);
  std::uint32_t tag_at(std::uint64_t offset, bool big) {
    return u16(offset, big) << 16 | u16(offset + 2, big);
  }
  /// The head of the element at `offset`; its value is not touched.
  DicomElementHead element(std::uint64_t offset, DicomEncoding encoding);

 protected:
  void need(std::uint64_t offset, void* to, std::size_t count);
  static void check_length(const DicomElementHead& e, std::uint64_t end);
  DicomSource& source_;
};

/// Where a file's content begins and how it seems to be written.
struct DicomStart {
  std::uint64_t offset = 0;
  bool preamble = false, has_meta = false;
  DicomEncoding encoding;  ///< of the data set, where there is no meta information
};
/// Nothing when it is not DICOM.
std::optional<DicomStart> dicom_start(DicomSource& source);
/// How the data set at `offset` is really encoded: some files say one thing and do the other.
DicomEncoding detected_encoding(DicomSource& source, std::uint64_t offset, DicomEncoding declared);

}  // namespace ostia::imaging
