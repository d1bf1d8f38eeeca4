#include "dicom_decode.h"

#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/dicom.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>

namespace ostia::imaging {
namespace {

constexpr std::size_t kLostBlock = 2048;  // zero bytes in a row

/// How the bits of a decoded word give the stored value.
struct Word {
  int shift = 0, bits = 16;
  bool is_signed = false;
};

std::int32_t stored_value(std::uint32_t raw, const Word& word) {
  raw >>= word.shift;
  if (word.bits >= 32) return static_cast<std::int32_t>(raw);
  const std::uint32_t mask = (1u << word.bits) - 1u;
  raw &= mask;
  const bool negative = word.is_signed && (raw >> (word.bits - 1)) != 0;
  return static_cast<std::int32_t>(negative ? raw | ~mask : raw);
}

std::vector<std::int32_t> values(const std::string& bytes, std::size_t sample_bytes, bool big_endian,
                                 const Word& word) {
  std::vector<std::int32_t> result(bytes.size() / sample_bytes);
  const unsigned char* at = reinterpret_cast<const unsigned char*>(bytes.data());
  for (std::int32_t& value : result) {
    std::uint32_t raw = 0;
    for (std::size_t b = 0; b < sample_bytes; ++b) raw = raw << 8 | at[big_endian ? b : sample_bytes - 1 - b];
    value = stored_value(raw, word);
    at += sample_bytes;
  }
  return result;
}

void check_stream(const DicomHeader& header, const StreamInfo& info) {
  if (info.columns == 0 || info.rows == 0)
    throw InvalidInput("the compressed pixel data have no header of their own");
  if (info.columns != static_cast<std::uint32_t>(header.columns) ||
      info.rows != static_cast<std::uint32_t>(header.rows)) {
    throw InvalidInput("the compressed image is " + std::to_string(info.rows) + " rows by " +
                       std::to_string(info.columns) + " columns, the file says " +
                       std::to_string(header.rows) + " by " + std::to_string(header.columns));
  }
  if (info.components != 1) {
    throw InvalidInput("the compressed image has " + std::to_string(info.components) + " components, not 1");
  }
  if (info.precision < 1 || info.precision > 16) {
    throw InvalidInput("the compressed image has " + std::to_string(info.precision) + " bits a pixel");
  }
  if (!info.whole) throw InvalidInput("the compressed pixel data are cut short: their end mark is missing");
}

/// Writes one slice; int16 where that holds all values.
void write_slice(std::ofstream& out, const DicomHeader& header, const std::vector<std::int32_t>& voxels) {
  const auto [low, high] = std::minmax_element(voxels.begin(), voxels.end());
  using Small = std::numeric_limits<std::int16_t>;
  SliceRecord record;
  record.columns = static_cast<std::uint32_t>(header.columns);
  record.rows = static_cast<std::uint32_t>(header.rows);
  record.voxel_bytes = *low >= Small::min() && *high <= Small::max() ? 2 : 4;
  out.write(reinterpret_cast<const char*>(&record), sizeof record);
  if (record.voxel_bytes == 4) {
    out.write(reinterpret_cast<const char*>(voxels.data()), static_cast<std::streamsize>(voxels.size() * 4));
  } else {
    const std::vector<std::int16_t> narrow(voxels.begin(), voxels.end());
    out.write(reinterpret_cast<const char*>(narrow.data()), static_cast<std::streamsize>(narrow.size() * 2));
  }
  if (!out) throw ResourceError("no room for the decoded voxels");
}

void decode_all(const std::vector<DecodeItem>& items, const std::filesystem::path& output_file) {
  std::ofstream out(output_file, std::ios::binary | std::ios::trunc);
  if (!out) throw IoError("cannot write '" + output_file.string() + "'");
  std::optional<DicomFile> file;
  for (std::size_t i = 0; i < items.size(); ++i) {
    std::fprintf(stderr, "%s%zu\n", kDecodeMark, i);
    std::fflush(stderr);
    if (!file || file->header.path != items[i].path) file = parse_dicom(items[i].path);
    if (!file) throw InvalidInput("not a DICOM file");
    write_slice(out, file->header, decode_frame(*file, items[i].frame));
  }
  out.close();
  if (!out) throw ResourceError("no room for the decoded voxels");
}

std::uint32_t byte_of(const std::string& stream, std::size_t i) {
  return static_cast<unsigned char>(stream[i]);
}

/// JPEG, JPEG-LS and JPEG 2000 alike end with the mark FF D9, padding aside.
bool ends_with_mark(const std::string& stream) {
  std::size_t end = stream.size();
  while (end > 2 && (byte_of(stream, end - 1) == 0 || byte_of(stream, end - 1) == 0xFF)) --end;
  return end >= 2 && byte_of(stream, end - 2) == 0xFF && byte_of(stream, end - 1) == 0xD9;
}

StreamInfo info_of(DicomCodec codec, const std::string& stream) {
  switch (codec) {
    case DicomCodec::jpeg_2000:
      return jpeg_2000_info(stream);
    case DicomCodec::jpeg:
    case DicomCodec::jpeg_ls:
      return jpeg_info(stream);
    case DicomCodec::native:
    case DicomCodec::rle:
    case DicomCodec::unknown:
      break;
  }
  throw InvalidInput("no codec for the pixel data");
}

}  // namespace

StreamInfo jpeg_info(const std::string& stream) {
  StreamInfo info;
  info.whole = ends_with_mark(stream);
  const auto byte = [&](std::size_t i) { return byte_of(stream, i); };
  if (stream.size() < 4 || byte(0) != 0xFF || byte(1) != 0xD8) return info;
  for (std::size_t at = 2; at + 10 <= stream.size() && byte(at) == 0xFF;) {
    const std::uint32_t mark = byte(at + 1);
    if (mark == 0xFF) {
      ++at;
      continue;
    }
    const bool frame =
        (mark >= 0xC0 && mark <= 0xCF && mark != 0xC4 && mark != 0xC8 && mark != 0xCC) || mark == 0xF7;
    if (frame) {
      info.precision = static_cast<int>(byte(at + 4));
      info.rows = byte(at + 5) << 8 | byte(at + 6);
      info.columns = byte(at + 7) << 8 | byte(at + 8);
      info.components = static_cast<int>(byte(at + 9));
      return info;
    }
    at += 2 + (byte(at + 2) << 8 | byte(at + 3));
  }
  return info;
}

StreamInfo jpeg_2000_info(const std::string& stream) {
  StreamInfo info;
  info.whole = ends_with_mark(stream);
  const auto byte = [&](std::size_t i) { return byte_of(stream, i); };
  // Some writers put the whole JP2 file where the codestream alone belongs.
  const std::size_t start = stream.find("\xFF\x4F\xFF\x51");
  if (start == std::string::npos || stream.size() < start + 43) return info;
  const auto word = [&](std::size_t i) {
    return byte(start + i) << 24 | byte(start + i + 1) << 16 | byte(start + i + 2) << 8 | byte(start + i + 3);
  };
  const std::uint32_t x1 = word(8), y1 = word(12), x0 = word(16), y0 = word(20);
  if (x1 <= x0 || y1 <= y0) return info;
  info.columns = x1 - x0;
  info.rows = y1 - y0;
  info.components = static_cast<int>(byte(start + 40) << 8 | byte(start + 41));
  info.precision = static_cast<int>(byte(start + 42) & 0x7F) + 1;
  info.is_signed = (byte(start + 42) & 0x80) != 0;
  return info;
}

bool jpeg_2000_sound(const std::string& stream) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(stream[i]));
  };
  const std::size_t start = stream.find("\xFF\x4F\xFF\x51");
  std::size_t end = stream.rfind("\xFF\xD9");
  if (start == std::string::npos || end == std::string::npos) return false;
  std::size_t at = start + 2;
  bool in_tile = false;
  std::size_t tile_end = end;
  while (at + 4 <= end) {
    if (byte(at) != 0xFF) return false;
    if (byte(at + 1) != 0x93) {  // a marker segment of the main header or of a tile part's
      if (byte(at + 1) == 0x90) {
        if (at + 12 > end) return false;
        const std::size_t length = byte(at + 6) << 24 | byte(at + 7) << 16 | byte(at + 8) << 8 | byte(at + 9);
        if (length != 0 && (length < 14 || length > end - at)) return false;
        tile_end = length == 0 ? end : at + length;
        in_tile = true;
      }
      at += 2 + (byte(at + 2) << 8 | byte(at + 3));
      continue;
    }
    // Start of data. Within packets only their own marks (SOP, EPH) may lie above FF8F (T.800 B.10.1, D.1).
    if (!in_tile) return false;
    // Nor are there so many empty packets as a lost block of a disk would make of it.
    std::size_t zeros = 0;
    for (std::size_t i = at + 2; i + 1 < tile_end; ++i) {
      zeros = byte(i) == 0 ? zeros + 1 : 0;
      if (zeros >= kLostBlock) return false;
      if (byte(i) == 0xFF && byte(i + 1) > 0x8F && byte(i + 1) != 0x91 && byte(i + 1) != 0x92) return false;
    }
    at = tile_end;
    in_tile = false;
  }
  return at == end;
}

std::string decode_rle(const std::string& stream, std::size_t pixels, std::size_t sample_bytes) {
  const auto word = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (int b = 3; b >= 0; --b)
      value = value << 8 | static_cast<unsigned char>(stream[4 * i + static_cast<std::size_t>(b)]);
    return static_cast<std::size_t>(value);
  };
  if (stream.size() < 64) throw InvalidInput("the RLE header is cut short");
  if (word(0) != sample_bytes) {
    throw InvalidInput(std::to_string(word(0)) + " RLE segments, " + std::to_string(sample_bytes) +
                       " needed");
  }
  std::string result(pixels * sample_bytes, '\0');
  for (std::size_t segment = 0; segment < sample_bytes; ++segment) {
    std::size_t at = word(1 + segment);
    const std::size_t end = segment + 1 < sample_bytes ? word(2 + segment) : stream.size();
    if (at < 64 || at > end || end > stream.size())
      throw InvalidInput("an RLE segment lies outside its frame");
    std::size_t done = 0;
    const auto put = [&](char c) { result[done++ * sample_bytes + (sample_bytes - 1 - segment)] = c; };
    while (done < pixels && at < end) {
      const int n = static_cast<signed char>(stream[at++]);
      if (n == -128) continue;
      const std::size_t count = static_cast<std::size_t>(n >= 0 ? n + 1 : 1 - n);
      const std::size_t used = n >= 0 ? count : 1;
      if (count > pixels - done || used > end - at) throw InvalidInput("damaged RLE data");
      for (std::size_t i = 0; i < count; ++i) put(stream[n >= 0 ? at + i : at]);
      at += used;
    }
    if (done != pixels) throw InvalidInput("the RLE data are cut short");
  }
  return result;
}

std::vector<std::int32_t> decode_frame(DicomFile& file, std::int64_t frame) {
  const DicomHeader& header = file.header;
  if (!header.damage.empty()) throw InvalidInput(header.damage);
  if (const std::string fault = pixel_fault(header); !fault.empty()) throw InvalidInput(fault);
  if (frame < 0 || frame >= header.frame_count) {
    throw InvalidInput("frame " + std::to_string(frame + 1) + " of " + std::to_string(header.frame_count));
  }
  const std::uint64_t bytes = frame_bytes(header);
  const std::size_t sample_bytes = static_cast<std::size_t>(header.bits_allocated / 8);
  const std::size_t pixels = static_cast<std::size_t>(bytes) / sample_bytes;
  const DicomCodec codec = dicom_codec(header.transfer_syntax);
  Word word{header.high_bit + 1 - header.bits_stored, header.bits_stored, header.is_signed};
  if (codec == DicomCodec::native) {
    const std::string raw = file.source.bytes(header.pixel_offset + static_cast<std::uint64_t>(frame) * bytes,
                                              static_cast<std::size_t>(bytes));
    if (raw.size() != bytes) throw InvalidInput("pixel data cut short");
    return values(raw, sample_bytes, header.big_endian, word);
  }
  const std::string stream = frame_stream(file, frame);
  if (codec == DicomCodec::rle)
    return values(decode_rle(stream, pixels, sample_bytes), sample_bytes, false, word);

  const StreamInfo info = info_of(codec, stream);
  check_stream(header, info);
  if (codec == DicomCodec::jpeg_2000 && !jpeg_2000_sound(stream)) {
    throw InvalidInput("the JPEG 2000 data are damaged");
  }
  // JPEG 2000 carries its own depth, which wins where the header contradicts it; the header wins on the sign.
  word.shift = 0;
  word.bits = codec == DicomCodec::jpeg_2000 ? info.precision : std::min(info.precision, header.bits_stored);
  const std::string raw = decode_stream(header, info, stream);
  const std::size_t decoded_bytes = info.precision <= 8 ? 1 : 2;
  if (raw.size() != pixels * decoded_bytes) {
    throw InvalidInput("the codec gave " + std::to_string(raw.size()) + " bytes for " +
                       std::to_string(pixels) + " pixels");
  }
  return values(raw, decoded_bytes, false, word);
}

int decode_dicom_files(const std::filesystem::path& list_file, const std::filesystem::path& output_file) {
  const auto failed = [](const char* message, ExitCode code) {
    std::fprintf(stderr, "%s\n", message);
    return static_cast<int>(code);
  };
  try {
    decode_all(read_decode_list(list_file), output_file);
    return 0;
  } catch (const Error& error) {
    return failed(error.what(), error.exit_code());
  } catch (const std::bad_alloc&) {
    return failed("out of memory", ExitCode::resources);
  } catch (const std::exception& error) {
    return failed(error.what(), ExitCode::bad_input);
  }
}

}  // namespace ostia::imaging
