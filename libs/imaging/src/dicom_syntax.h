#pragma once
/// \file What is known of transfer syntaxes, and whether pixel data can be as long as the header says.

#include "dicom_parser.h"

namespace ostia::imaging {

/// UIDs of the transfer syntaxes without compression of pixels, by which a data set is read or written
/// (PS3.5, annex A).
inline constexpr const char* implicit_little_endian = "1.2.840.10008.1.2";
inline constexpr const char* explicit_little_endian = "1.2.840.10008.1.2.1";
inline constexpr const char* deflated_little_endian = "1.2.840.10008.1.2.1.99";
inline constexpr const char* explicit_big_endian = "1.2.840.10008.1.2.2";

enum class DicomCodec { native, rle, jpeg, jpeg_ls, jpeg_2000, unknown };

DicomCodec dicom_codec(const std::string& transfer_syntax);
/// "JPEG 2000 (lossless)", or the UID itself.
std::string transfer_syntax_name(const std::string& transfer_syntax);

/// Bytes of one decoded frame; 0 when the product overflows or an attribute is missing.
std::uint64_t frame_bytes(const DicomHeader& header);

/// Why the pixel data of this file cannot be decoded to scalar voxels, in words; empty when they can. Nothing
/// is allocated.
std::string pixel_fault(const DicomHeader& header);

/// The stream of one compressed frame put together from its fragments, by their number, the offset table, or
/// the marks that begin a stream. Throws InvalidInput.
std::string frame_stream(DicomFile& file, std::int64_t frame);

}  // namespace ostia::imaging
