#pragma once
/// \file The voxels of an image file as a stream of bytes. Private to the room.

#include "image_source.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace ostia::imaging {

/// The bytes of a file from an offset on, decompressed if need be; never more of them than are asked for.
class ByteStream {
 public:
  ByteStream(const std::filesystem::path& file, std::uint64_t offset, bool compressed);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  /// Fills `to` as far as there is data; fewer than `count` bytes mean that the data end there. Throws
  /// InvalidInput for compressed data that are cut or damaged.
  std::size_t read(char* to, std::size_t count);

 private:
  struct Inflater;
  std::size_t read_file(char* to, std::size_t count);
  std::size_t inflate_to(char* to, std::size_t count);
  std::filesystem::path file_;
  std::ifstream in_;
  std::unique_ptr<Inflater> inflater_;
};

/// The voxels of `source` in their stored order and type, in this machine's byte order.
class VoxelStream {
 public:
  explicit VoxelStream(const ImageSource& source);
  /// The next `count` voxels; `to` has room for them. Throws InvalidInput where the data end early.
  void read(void* to, std::size_t count);
  /// After the last voxel: verifies the check sum; true when there is more data than the header says (it is
  /// not read).
  bool more_than_needed();

 private:
  void read_text(char* to, std::size_t count);
  std::string_view next_word();
  const ImageSource& source_;
  ByteStream bytes_;
  std::string text_;
  std::size_t at_ = 0;
  bool text_ended_ = false;
  std::size_t done_ = 0;
};

/// The first bytes of a file, at most `count`, decompressed when it is a gzip file.
std::string file_head(const std::filesystem::path& file, std::size_t count, bool& compressed);

/// Throws unless the data file is large enough for what the header says.
void check_data_size(const ImageSource& source);

}  // namespace ostia::imaging
