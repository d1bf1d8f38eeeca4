#pragma once
/// \file Large text files, written block by block and whole or not at all.

#include "ostia/core/files.h"
#include "ostia/core/task_context.h"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace ostia::io {

/// Throws IoError, ResourceError on a full disk, and Cancelled between blocks.
class TextWriter {
 public:
  TextWriter(const std::filesystem::path& path, const core::TaskContext& task);
  void text(std::string_view words) {
    block_ += words;
    if (block_.size() > block_bytes) flush();
  }
  void whole(std::int64_t value) { put(value); }
  /// Behind a separator; as short as reads back to the same bits.
  void number(char separator, double value) {
    block_ += separator;
    put(value);
  }
  void first_number(double value) { put(value); }
  void commit();

 private:
  static constexpr std::size_t block_bytes = std::size_t{1} << 20;
  template <class T>
  void put(T value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text({digits, static_cast<std::size_t>(end - digits)});
  }
  void flush();

  core::StagedFile file_;
  core::TaskContext task_;
  std::ofstream out_;
  std::string block_;
};

}  // namespace ostia::io
