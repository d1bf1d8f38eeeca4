#pragma once
/// \file From the values of elements to a DicomHeader.

#include "dicom_parser.h"

#include <string>
#include <string_view>

namespace ostia::imaging {

/// Thrown inside the parser: the file is damaged. Becomes DicomHeader::damage.
struct DicomDamage {
  std::string message;
};

constexpr std::uint32_t dicom_tag(std::uint32_t group, std::uint32_t element) {
  return group << 16 | element;
}
/// "(0028,0030)".
std::string tag_name(std::uint32_t tag);

/// The attributes common to all frames as they are met.
struct DicomAttributes {
  DicomHeader header;
  DicomFrame shared;                  ///< of the data set itself, then of the shared functional groups
  std::vector<DicomFrame> per_frame;  ///< of the per-frame functional groups

  /// Whether the value of this element of the data set is wanted at all.
  static bool wanted(std::uint32_t tag);
  /// Whether it is wanted inside the functional group sequence `macro`.
  static bool wanted_in_macro(std::uint32_t macro, std::uint32_t tag);
  /// An element of the data set itself. Throws DicomDamage for a number that is none.
  void set(std::uint32_t tag, std::string_view value, bool big_endian);
  /// An element of a frame: of the data set or of a functional group. Returns false when the tag is not one
  /// of those.
  static bool set_frame(DicomFrame& frame, std::uint32_t tag, std::string_view value, bool big_endian);
  /// Completes `header.frames`; throws DicomDamage when the number of frames contradicts the rest.
  void finish();
};

}  // namespace ostia::imaging
