#include "dicom_syntax.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <map>
#include <utility>

namespace ostia::imaging {
namespace {

using Known = std::pair<DicomCodec, const char*>;

const std::map<std::string, Known>& known() {
  static const std::map<std::string, Known> table{
      {implicit_little_endian, {DicomCodec::native, "implicit VR little endian"}},
      {explicit_little_endian, {DicomCodec::native, "explicit VR little endian"}},
      {deflated_little_endian, {DicomCodec::native, "deflated"}},
      {explicit_big_endian, {DicomCodec::native, "explicit VR big endian"}},
      {"1.2.840.10008.1.2.4.50", {DicomCodec::jpeg, "JPEG (lossy, 8 bits)"}},
      {"1.2.840.10008.1.2.4.51", {DicomCodec::jpeg, "JPEG (lossy, 12 bits)"}},
      {"1.2.840.10008.1.2.4.57", {DicomCodec::jpeg, "JPEG (lossless)"}},
      {"1.2.840.10008.1.2.4.70", {DicomCodec::jpeg, "JPEG (lossless)"}},
      {"1.2.840.10008.1.2.4.80", {DicomCodec::jpeg_ls, "JPEG-LS (lossless)"}},
      {"1.2.840.10008.1.2.4.81", {DicomCodec::jpeg_ls, "JPEG-LS (near-lossless)"}},
      {"1.2.840.10008.1.2.4.90", {DicomCodec::jpeg_2000, "JPEG 2000 (lossless)"}},
      {"1.2.840.10008.1.2.4.91", {DicomCodec::jpeg_2000, "JPEG 2000"}},
      {"1.2.840.10008.1.2.5", {DicomCodec::rle, "RLE (lossless)"}},
  };
  return table;
}

std::string size_text(const DicomHeader& h) {
  return std::to_string(h.rows) + " rows x " + std::to_string(h.columns) + " columns x " +
         std::to_string(h.frame_count) + " frames x " + std::to_string(h.bits_allocated / 8) + " bytes";
}

std::string native_fault(const DicomHeader& h, std::uint64_t needed) {
  if (h.pixel_available < h.pixel_length) {
    return "pixel data cut short: " + std::to_string(h.pixel_length) + " bytes announced, " +
           std::to_string(h.pixel_available) + " there";
  }
  if (h.pixel_length < needed) {
    return "pixel data too short: " + size_text(h) + " are " + std::to_string(needed) + " bytes, " +
           std::to_string(h.pixel_length) + " are there";
  }
  return {};
}

std::string encapsulated_fault(const DicomHeader& h, std::uint64_t needed) {
  std::uint64_t compressed = 0;
  for (const DicomFragment& fragment : h.fragments) compressed += fragment.length;
  if (compressed == 0) return "the compressed pixel data are empty";
  if (h.fragments.size() < static_cast<std::size_t>(h.frame_count) && h.frame_count > 1) {
    return std::to_string(h.frame_count) + " frames, but " + std::to_string(h.fragments.size()) +
           " compressed fragments";
  }
  // No codec here packs a real image more than some thousand times; what claims more would only fill the
  // memory.
  if (needed / 100'000 > compressed) {
    return std::to_string(compressed) + " bytes of compressed pixel data cannot be " + size_text(h);
  }
  return {};
}

bool starts_stream(DicomSource& source, const DicomFragment& fragment) {
  unsigned char b[3] = {0, 0, 0};
  if (fragment.length < 3 || !source.read(fragment.offset, b, sizeof b)) return false;
  return b[0] == 0xFF && ((b[1] == 0xD8 && b[2] == 0xFF) || (b[1] == 0x4F && b[2] == 0xFF));
}

/// Indices of the fragments that begin a frame.
std::vector<std::size_t> frame_starts(DicomFile& file) {
  const DicomHeader& h = file.header;
  const std::size_t frames = static_cast<std::size_t>(h.frame_count);
  std::vector<std::size_t> starts;
  if (frames == 1) return {0};
  if (h.fragments.size() == frames) {
    for (std::size_t i = 0; i < frames; ++i) starts.push_back(i);
    return starts;
  }
  if (h.offset_table.size() == frames && !h.fragments.empty()) {
    // Offsets count from the first fragment's item tag, eight bytes before its content.
    const std::uint64_t base = h.fragments.front().offset;
    for (const std::uint32_t offset : h.offset_table) {
      const auto found =
          std::lower_bound(h.fragments.begin(), h.fragments.end(), base + offset,
                           [](const DicomFragment& f, std::uint64_t at) { return f.offset < at; });
      if (found == h.fragments.end() || found->offset != base + offset) break;
      starts.push_back(static_cast<std::size_t>(found - h.fragments.begin()));
    }
    if (starts.size() == frames && std::is_sorted(starts.begin(), starts.end())) return starts;
    starts.clear();
  }
  for (std::size_t i = 0; i < h.fragments.size(); ++i) {
    if (starts_stream(file.source, h.fragments[i])) starts.push_back(i);
  }
  return starts;
}

}  // namespace

DicomCodec dicom_codec(const std::string& transfer_syntax) {
  const auto found = known().find(transfer_syntax);
  return found == known().end() ? DicomCodec::unknown : found->second.first;
}

std::string transfer_syntax_name(const std::string& transfer_syntax) {
  const auto found = known().find(transfer_syntax);
  return found == known().end() ? transfer_syntax : found->second.second;
}

std::uint64_t frame_bytes(const DicomHeader& h) {
  // 16 bits each for rows, columns and samples and at most 8 bytes a sample: below 2^52.
  return static_cast<std::uint64_t>(h.rows) * static_cast<std::uint64_t>(h.columns) *
         static_cast<std::uint64_t>(h.samples) * static_cast<std::uint64_t>(h.bits_allocated / 8);
}

std::string pixel_fault(const DicomHeader& h) {
  if (!h.has_pixels) return "it holds no pixel data";
  if (h.rows <= 0 || h.columns <= 0) {
    return "its size is " + std::to_string(h.rows) + " rows by " + std::to_string(h.columns) + " columns";
  }
  const bool gray = h.photometric.empty() || h.photometric == "MONOCHROME1" || h.photometric == "MONOCHROME2";
  if (h.samples != 1 || !gray) {
    return "a colour image (" + h.photometric + ", " + std::to_string(h.samples) +
           " samples a pixel), not a scalar one";
  }
  if (h.bits_allocated != 8 && h.bits_allocated != 16 && h.bits_allocated != 32) {
    return std::to_string(h.bits_allocated) + " bits a pixel; 8, 16 and 32 can be read";
  }
  if (h.bits_stored < 1 || h.bits_stored > h.bits_allocated || h.high_bit >= h.bits_allocated ||
      h.high_bit + 1 < h.bits_stored) {
    return "BitsStored " + std::to_string(h.bits_stored) + " and HighBit " + std::to_string(h.high_bit) +
           " contradict " + std::to_string(h.bits_allocated) + " bits allocated";
  }
  if (h.big_endian && h.bits_allocated == 8) return "8-bit pixels in big endian words";
  if (h.bits_stored == 32 && !h.is_signed) return "unsigned 32-bit pixels";
  if (h.has_modality_lut) return "it maps values by a Modality LUT, not by slope and intercept";
  const DicomCodec codec = dicom_codec(h.transfer_syntax);
  if (codec == DicomCodec::unknown) return "transfer syntax " + h.transfer_syntax + " cannot be read";
  if (h.encapsulated != (codec != DicomCodec::native)) {
    return "transfer syntax " + transfer_syntax_name(h.transfer_syntax) +
           " contradicts the form of the pixel data";
  }
  const std::uint64_t needed =
      frame_bytes(h) * static_cast<std::uint64_t>(h.frame_count);  // below 2^50 * 10^5
  if (frame_bytes(h) > (1ULL << 40)) return size_text(h) + " is more than can be read";
  return h.encapsulated ? encapsulated_fault(h, needed) : native_fault(h, needed);
}

std::string frame_stream(DicomFile& file, std::int64_t frame) {
  const DicomHeader& h = file.header;
  const std::vector<std::size_t> starts = frame_starts(file);
  if (starts.size() != static_cast<std::size_t>(h.frame_count)) {
    throw InvalidInput(std::to_string(h.fragments.size()) +
                       " fragments of pixel data cannot be told apart into " + std::to_string(h.frame_count) +
                       " frames");
  }
  const std::size_t index = static_cast<std::size_t>(frame);
  const std::size_t first = starts.at(index);
  const std::size_t last = index + 1 < starts.size() ? starts[index + 1] : h.fragments.size();
  std::string stream;
  for (std::size_t i = first; i < last; ++i) {
    stream += file.source.bytes(h.fragments[i].offset, h.fragments[i].length);
  }
  if (stream.empty()) throw InvalidInput("frame " + std::to_string(frame + 1) + " holds no data");
  return stream;
}

}  // namespace ostia::imaging
