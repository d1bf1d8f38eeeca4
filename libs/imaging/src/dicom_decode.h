#pragma once
/// \file What the reader and the decoding child agree on.

#include "dicom_parser.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::imaging {

/// One slice to decode.
struct DecodeItem {
  std::filesystem::path path;
  std::int64_t frame = 0;
};

/// The list file: kDecodeMagic, then path and frame number in turn, each ended by a zero byte.
void write_decode_list(const std::filesystem::path& list_file, const std::vector<DecodeItem>& items);
std::vector<DecodeItem> read_decode_list(const std::filesystem::path& list_file);

/// The output file: for each slice this little-endian header and then columns x rows stored values, int16 or
/// int32.
struct SliceRecord {
  std::uint32_t voxel_bytes = 2;  ///< 2 or 4
  std::uint32_t columns = 0, rows = 0;
};

/// Before a slice is decoded the child writes this and the slice's number (from 0) on a line of its own to
/// stderr.
inline constexpr const char* kDecodeMark = "@slice ";

/// Stored values of one frame: sign-extended, bits above those stored masked. Throws InvalidInput.
std::vector<std::int32_t> decode_frame(DicomFile& file, std::int64_t frame);

/// Where a compressed stream says what it holds; zero where it says nothing.
struct StreamInfo {
  std::uint32_t columns = 0, rows = 0;
  int components = 0, precision = 0;
  bool is_signed = false;
  bool whole = false;  ///< ends with its end mark
};
StreamInfo jpeg_info(const std::string& stream);
StreamInfo jpeg_2000_info(const std::string& stream);
/// Whether tile parts follow each other without a gap and hold no byte pairs that cannot occur in them. The
/// format has no checksum, and its decoder makes pixels of anything: this is what can be known.
bool jpeg_2000_sound(const std::string& stream);

/// PackBits as in PS3.5 annex G: one segment a byte of the sample, most significant first. Returns
/// little-endian samples. Throws InvalidInput when a segment does not give exactly `pixels` bytes.
std::string decode_rle(const std::string& stream, std::size_t pixels, std::size_t sample_bytes);

/// JPEG, JPEG-LS and JPEG 2000 by GDCM's codecs. Returns little-endian samples of 1 byte (precision <= 8)
/// or 2. Throws InvalidInput.
std::string decode_stream(const DicomHeader& header, const StreamInfo& info, const std::string& stream);

}  // namespace ostia::imaging
