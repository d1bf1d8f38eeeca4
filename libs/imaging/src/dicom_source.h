#pragma once
/// \file Bounded reading from a file or from memory.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::imaging {

/// Bytes that can be read anywhere; every read is checked against the size. Files are read through a small
/// window, so that a header costs little however large its pixel data are.
class DicomSource {
 public:
  /// Throws IoError when the file cannot be opened or is not a regular file.
  static DicomSource file(const std::filesystem::path& path);
  static DicomSource memory(std::string bytes);
  ~DicomSource();
  DicomSource(DicomSource&& other) noexcept;
  DicomSource& operator=(DicomSource&& other) noexcept;

  std::uint64_t size() const { return size_; }
  /// False, and nothing read, unless all of [offset, offset + count) exists.
  bool read(std::uint64_t offset, void* to, std::size_t count);
  /// The bytes [offset, offset + count); empty when they are not all there.
  std::string bytes(std::uint64_t offset, std::size_t count);

 private:
  DicomSource() = default;
  bool fill(std::uint64_t offset);

  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string memory_;
  std::uint64_t window_start_ = 0;
  std::vector<char> window_;
};

/// Raw deflate (RFC 1951, as in "Deflated Explicit VR Little Endian") from `offset` to the end. Throws
/// InvalidInput when the stream is damaged, cut short, or larger than `max_bytes`.
std::string inflated(DicomSource& source, std::uint64_t offset, std::uint64_t max_bytes);

}  // namespace ostia::imaging
