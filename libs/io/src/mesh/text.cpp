#include "mesh/text.h"

#include "ostia/core/error.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

namespace ostia::io {
namespace {
constexpr std::size_t block_bytes = 1 << 20;
}

void throw_cannot_write(const std::filesystem::path& path, int code) {
  const std::string message = "cannot write " + path.string() + ": " + std::generic_category().message(code);
  if (code == ENOSPC || code == EDQUOT || code == EFBIG)
    throw ResourceError(message + "; make room and try again");
  throw IoError(message);
}

void write_whole(const std::filesystem::path& file, std::string_view content) {
  TextFile out(file);
  out << content;
  out.close();
}

void make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw_cannot_write(folder, error.value());
}

TextFile::TextFile(std::filesystem::path path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "wbe")) {
  if (!file_) throw_cannot_write(path_, errno);
  buffer_.reserve(block_bytes + 4096);
}

TextFile::~TextFile() {
  if (file_) std::fclose(file_);
}

TextFile& TextFile::operator<<(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() >= block_bytes) flush();
  return *this;
}

TextFile& TextFile::operator<<(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

TextFile& TextFile::integer(std::int64_t value) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return *this << std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data()));
}

void TextFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size())
    throw_cannot_write(path_, errno);
  buffer_.clear();
}

void TextFile::close() {
  flush();
  if (std::fclose(std::exchange(file_, nullptr)) != 0) throw_cannot_write(path_, errno);
}

}  // namespace ostia::io
