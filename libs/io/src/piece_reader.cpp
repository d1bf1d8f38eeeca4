#include "piece_reader.h"

#include "surface_formats.h"

#include <algorithm>
#include <cstring>

namespace ostia::io {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;
constexpr std::size_t longest_piece = std::size_t{1} << 20;

}  // namespace

PieceReader::PieceReader(const std::filesystem::path& path, const core::TaskContext& task)
    : path_(path), task_(task), file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
  if (!file_) throw IoError("cannot read " + path.string() + ": it cannot be opened");
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error && bytes > 0) bytes_ = static_cast<double>(bytes);
  buffer_.resize(block_bytes);
}

/// Moves what is left to the front and reads behind it; false at the end of the file.
bool PieceReader::fill() {
  task_.throw_if_cancelled();
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) {
    if (end_ > longest_piece) {
      line_ = next_line_;
      refuse_line("it is longer than 1 MiB, which no tree's file needs", "");
    }
    buffer_.resize(2 * buffer_.size());
  }
  const std::size_t read = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (read == 0 && std::ferror(file_.get()) != 0)
    throw IoError("cannot read " + path_.string() + ": the disk or the network reports an error");
  end_ += read;
  passed_ += static_cast<double>(read);
  task_.set_progress(passed_ / bytes_);
  return read > 0;
}

bool PieceReader::take(char stop, std::string_view& piece) {
  std::size_t searched = 0;
  for (;;) {
    const char* const from = buffer_.data() + begin_ + searched;
    const auto* const at = static_cast<const char*>(std::memchr(from, stop, end_ - begin_ - searched));
    const bool found = at != nullptr;
    const std::size_t length = found ? static_cast<std::size_t>(at - buffer_.data()) - begin_ : end_ - begin_;
    searched = length;
    if (!found && fill()) continue;
    if (!found && length == 0) return false;
    stopped_ = found;
    piece = {buffer_.data() + begin_, length};
    begin_ += length + (found ? 1 : 0);
    line_ = next_line_;
    next_line_ += stop == '\n' ? 1 : static_cast<std::size_t>(std::count(piece.begin(), piece.end(), '\n'));
    return true;
  }
}

bool PieceReader::line(std::string_view& text) {
  if (!take('\n', text)) return false;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return true;
}

void PieceReader::refuse_line(const std::string& what, const std::string& read) const {
  refuse(path_, "line " + std::to_string(line_) + ": " + what + (read.empty() ? "" : " (" + read + ")"));
}

}  // namespace ostia::io
