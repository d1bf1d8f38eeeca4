#include "image_data.h"

#include "pixel_types.h"

#include "ostia/core/error.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace ostia::imaging {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18;

template <class T>
T byte_swapped(T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  std::reverse(bytes, bytes + sizeof(T));
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

}  // namespace

struct ByteStream::Inflater {
  z_stream z{};
  std::vector<unsigned char> input = std::vector<unsigned char>(block_bytes);
  bool ended = false;
  Inflater() {
    if (inflateInit2(&z, 15 + 32) != Z_OK)
      throw ResourceError("zlib: out of memory");  // 32: gzip or zlib, by its header
  }
  ~Inflater() { inflateEnd(&z); }
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
  z_stream& z = inflater_->z;
  std::size_t done = 0;
  while (done < count) {
    if (z.avail_in == 0) {
      z.next_in = inflater_->input.data();
      z.avail_in =
          static_cast<uInt>(read_file(reinterpret_cast<char*>(inflater_->input.data()), block_bytes));
      if (z.avail_in == 0) {
        if (inflater_->ended) break;
        refuse(file_, "compressed data", "cut short: they end before their own end mark");
      }
    }
    if (inflater_->ended) {
      if (z.next_in[0] != 0x1f) break;  // what follows is no further gzip member
      inflateReset(&z);
      inflater_->ended = false;
    }
    const std::size_t room = std::min(count - done, block_bytes);
    z.next_out = reinterpret_cast<Bytef*>(to + done);
    z.avail_out = static_cast<uInt>(room);
    const int code = inflate(&z, Z_NO_FLUSH);
    done += room - z.avail_out;
    if (code == Z_STREAM_END) {
      inflater_->ended = true;
    } else if (code == Z_MEM_ERROR) {
      throw ResourceError(file_.string() + ": out of memory while decompressing");
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      refuse(file_, "compressed data",
             std::string("damaged (") + (z.msg ? z.msg : "no gzip or zlib stream") + ")");
    }
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
