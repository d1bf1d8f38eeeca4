#include "image_data.h"

#include "pixel_types.h"

#include "ostia/core/error.h"

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace ostia::imaging {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18;
constexpr std::uint8_t gzip_mark = 0x1f;

const char* fault(int code) {
  switch (code) {
    case ISAL_INVALID_BLOCK:
      return "invalid block";
    case ISAL_INVALID_SYMBOL:
      return "invalid symbol";
    case ISAL_INVALID_LOOKBACK:
      return "invalid distance";
    case ISAL_INCORRECT_CHECKSUM:
      return "wrong check sum";
    default:
      return "no gzip or zlib stream";
  }
}

template <class T>
T byte_swapped(T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

}  // namespace

/// ISA-L's, which takes half of zlib's time: of a CT volume the inflating is most of the reading.
struct ByteStream::Inflater {
  inflate_state state;
  std::vector<std::uint8_t> input = std::vector<std::uint8_t>(block_bytes);
  bool begun = false;
  Inflater() { isal_inflate_init(&state); }
  /// A gzip member or a zlib stream, by its first byte.
  void begin() {
    isal_inflate_reset(&state);
    state.crc_flag = state.next_in[0] == gzip_mark ? ISAL_GZIP : ISAL_ZLIB;
    begun = true;
  }
  bool ended() const { return begun && state.block_state == ISAL_BLOCK_FINISH; }
};

ByteStream::ByteStream(const std::filesystem::path& file, std::uint64_t offset, bool compressed)
    : file_(file), in_(file, std::ios::binary) {
  if (!in_) throw IoError(file.string() + ": cannot be opened for reading");
  in_.seekg(static_cast<std::streamoff>(offset));
  if (compressed) inflater_ = std::make_unique<Inflater>();
}
ByteStream::~ByteStream() = default;

std::size_t ByteStream::read(char* to, std::size_t count) {
  return inflater_ ? inflate_to(to, count) : read_file(to, count);
}

std::size_t ByteStream::read_file(char* to, std::size_t count) {
  in_.read(to, static_cast<std::streamsize>(count));
  if (in_.bad()) throw IoError(file_.string() + ": reading failed");
  return static_cast<std::size_t>(in_.gcount());
}

std::size_t ByteStream::inflate_to(char* to, std::size_t count) {
  Inflater& inflater = *inflater_;
  inflate_state& state = inflater.state;
  std::size_t done = 0;
  while (done < count) {
    if (state.avail_in == 0) {
      state.next_in = inflater.input.data();
      state.avail_in =
          static_cast<std::uint32_t>(read_file(reinterpret_cast<char*>(inflater.input.data()), block_bytes));
    }
    const bool no_more_input = state.avail_in == 0;
    if (inflater.ended() && (no_more_input || state.next_in[0] != gzip_mark))
      break;  // what follows is no further gzip member
    if (!no_more_input && (!inflater.begun || inflater.ended())) inflater.begin();
    const std::size_t room = std::min(count - done, block_bytes);
    state.next_out = reinterpret_cast<std::uint8_t*>(to + done);
    state.avail_out = static_cast<std::uint32_t>(room);
    const int code = inflater.begun ? isal_inflate(&state) : ISAL_END_INPUT;
    done += room - state.avail_out;
    if (code < 0) refuse(file_, "compressed data", std::string("damaged (") + fault(code) + ")");
    // Without input there may still be output in the inflater's own buffer.
    if (no_more_input && state.avail_out == room && !inflater.ended())
      refuse(file_, "compressed data", "cut short: they end before their own end mark");
  }
  return done;
}

VoxelStream::VoxelStream(const ImageSource& source)
    : source_(source), bytes_(source.data_path, source.offset, source.encoding == Encoding::deflate) {
  std::vector<char> passed(static_cast<std::size_t>(std::min<std::uint64_t>(source.skip, block_bytes)));
  for (std::uint64_t left = source.skip; left > 0;) {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, passed.size()));
    if (bytes_.read(passed.data(), count) != count)
      refuse(source.data_path, "voxels", "the data begin beyond the file's end");
    left -= count;
  }
}

void VoxelStream::read(void* to, std::size_t count) {
  char* bytes = static_cast<char*>(to);
  if (source_.encoding == Encoding::text) {
    read_text(bytes, count);
  } else {
    const std::size_t size = static_cast<std::size_t>(bytes_of(source_.pixel_type));
    const std::size_t got = bytes_.read(bytes, count * size);
    if (got != count * size)
      refuse(source_.data_path, "voxels",
             "the file is cut short: " + std::to_string(source_.bytes()) +
                 " bytes of voxels are announced, " + std::to_string(done_ * size + got) + " are there");
    if (source_.big_endian != (std::endian::native == std::endian::big) && size > 1)
      with_pixel_type(source_.pixel_type, [&](auto zero) {
        using Stored = decltype(zero);
        Stored* values = static_cast<Stored*>(to);
        for (std::size_t i = 0; i < count; ++i) values[i] = byte_swapped(values[i]);
      });
  }
  done_ += count;
}

std::string_view VoxelStream::next_word() {
  constexpr const char* blank = " \t\r\n,";
  while (true) {
    const std::size_t start = text_.find_first_not_of(blank, at_);
    const std::size_t end = start == std::string::npos ? start : text_.find_first_of(blank, start);
    if (end != std::string::npos || text_ended_) {
      if (start == std::string::npos) return {};
      at_ = std::min(end, text_.size());
      return std::string_view(text_).substr(start, at_ - start);
    }
    text_.erase(0, start == std::string::npos ? text_.size() : start);
    at_ = 0;
    if (text_.size() > 4096)
      refuse(source_.data_path, "voxels", "the text has a word of more than 4096 letters");
    const std::size_t had = text_.size();
    text_.resize(had + block_bytes);
    const std::size_t got = bytes_.read(text_.data() + had, block_bytes);
    text_.resize(had + got);
    text_ended_ = got == 0;
  }
}

void VoxelStream::read_text(char* to, std::size_t count) {
  with_pixel_type(source_.pixel_type, [&](auto zero) {
    using Stored = decltype(zero);
    for (std::size_t i = 0; i < count; ++i, to += sizeof(Stored)) {
      const std::string_view word = next_word();
      const std::string place = "voxel " + std::to_string(done_ + i);
      if (word.empty())
        refuse(source_.data_path, "voxels",
               "the file is cut short: " + std::to_string(source_.voxels()) + " numbers are announced, " +
                   std::to_string(done_ + i) + " are there");
      Stored value{};
      bool good = false;
      if constexpr (std::is_integral_v<Stored>) {
        const auto number = to_integer(word);
        good = number && std::in_range<Stored>(*number);
        if (good) value = static_cast<Stored>(*number);
      } else {
        const auto number = to_double(word);
        good = number.has_value();
        if (good) value = static_cast<Stored>(*number);
      }
      if (!good)
        refuse(source_.data_path, place, "'" + std::string(word) + "' is no number of the header's type");
      std::memcpy(to, &value, sizeof(Stored));
    }
  });
}

bool VoxelStream::more_than_needed() {
  if (source_.encoding == Encoding::text) return !next_word().empty();
  char one = 0;
  return bytes_.read(&one, 1) == 1;
}

std::string file_head(const std::filesystem::path& file, std::size_t count, bool& compressed) {
  std::string head(count, '\0');
  head.resize(ByteStream(file, 0, false).read(head.data(), count));
  compressed = head.size() >= 2 && head[0] == '\x1f' && head[1] == '\x8b';
  if (!compressed) return head;
  ByteStream stream(file, 0, true);
  std::string plain;
  try {
    // In small steps: of a file that is cut or damaged, what comes before is kept, so that its header can be
    // named.
    for (char block[512]; plain.size() < std::min<std::size_t>(count, 4096);) {
      const std::size_t got = stream.read(block, sizeof block);
      plain.append(block, got);
      if (got < sizeof block) break;
    }
  } catch (const InvalidInput&) {
    if (plain.empty()) throw;
  }
  return plain;
}

void check_data_size(const ImageSource& source) {
  const std::uint64_t file = regular_file_size(source.data_path), need = source.bytes();
  if (file == 0) refuse(source.data_path, "voxels", "the data file is empty");
  if (source.offset >= file || (source.encoding == Encoding::raw && source.skip >= file))
    refuse(source.data_path, "data offset",
           "the voxels are said to begin at byte " + std::to_string(std::max(source.offset, source.skip)) +
               ", but the file has " + std::to_string(file) + " bytes");
  const std::uint64_t there = file - source.offset;
  std::uint64_t most = there;
  if (source.encoding == Encoding::raw) most = there - std::min(there, source.skip);
  // Deflate cannot pack more than 1032 bytes into one; text needs a digit and a blank a voxel.
  if (source.encoding == Encoding::deflate) most = there > (std::uint64_t{1} << 50) ? there : there * 1032;
  if (source.encoding == Encoding::text)
    most = (there + 1) / 2 * static_cast<std::uint64_t>(bytes_of(source.pixel_type));
  const std::uint64_t wanted = need + (source.encoding == Encoding::deflate ? source.skip : 0);
  if (most < wanted)
    refuse(source.data_path, "voxels",
           "the file is cut short: the header announces " + std::to_string(source.size[0]) + " x " +
               std::to_string(source.size[1]) + " x " + std::to_string(source.size[2]) + " voxels (" +
               std::to_string(need) + " bytes), the file cannot hold more than " + std::to_string(most));
}

}  // namespace ostia::imaging
