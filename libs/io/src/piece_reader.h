#pragma once
/// \file Large text files piece by piece, with their lines counted.

#include "ostia/core/task_context.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace ostia::io {

/// Reads a file in blocks. A piece ends at a character that the caller names. Sets the task's progress and
/// throws Cancelled; IoError for a file that cannot be read.
class PieceReader {
 public:
  PieceReader(const std::filesystem::path& path, const core::TaskContext& task);

  /// The text up to `stop`, which is passed; valid until the next call. At the end of the file what is left,
  /// and false when nothing is. Throws InvalidInput for a piece of more than 1 MiB.
  bool take(char stop, std::string_view& piece);
  /// A line without its end, "\n" or "\r\n".
  bool line(std::string_view& text);

  bool stopped() const { return stopped_; }  ///< the last piece ended in its `stop`, not with the file
  std::size_t line_number() const { return line_; }  ///< where the last piece began, from 1
  /// Throws InvalidInput "cannot read FILE: line N: WHAT (READ)", where READ says what was read so far.
  [[noreturn]] void refuse_line(const std::string& what, const std::string& read) const;

 private:
  bool fill();

  std::filesystem::path path_;
  core::TaskContext task_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string buffer_;
  std::size_t begin_ = 0, end_ = 0;  // what of the buffer is not taken yet
  std::size_t line_ = 1, next_line_ = 1;
  double bytes_ = 1.0, passed_ = 0.0;
  bool stopped_ = false;
};

}  // namespace ostia::io
