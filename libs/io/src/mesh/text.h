#pragma once
/// \file Files inside what is staged, and large texts piece by piece, whose numbers do not depend on the
/// locale.

#include <concepts>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::io {

/// Throws ResourceError on a full disk, IoError otherwise, for `errno` after a failed write.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& path, int code);

/// A file of that content, and folders with those above them, inside what export_mesh has staged.
void write_whole(const std::filesystem::path& file, std::string_view content);
void make_folders(const std::filesystem::path& folder);

/// Written piece by piece; it is whole once `close` has returned.
class TextFile {
 public:
  explicit TextFile(std::filesystem::path path);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  TextFile& operator<<(std::string_view text);
  TextFile& operator<<(const char* text) { return *this << std::string_view(text); }
  TextFile& operator<<(char c) { return *this << std::string_view(&c, 1); }
  /// The shortest text that reads back as the same number.
  TextFile& operator<<(double value);
  template <std::integral T>
  TextFile& operator<<(T value) {
    return integer(static_cast<std::int64_t>(value));
  }
  /// What is still in memory goes to the file.
  void close();

 private:
  TextFile& integer(std::int64_t value);
  void flush();
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
};

}  // namespace ostia::io
