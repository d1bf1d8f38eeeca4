#pragma once
/// \file The readers and writers behind surface_file.h, one source each.

#include "ostia/io/surface_file.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ostia::io {

LoadedSurface read_stl(const std::filesystem::path& path);
LoadedSurface read_ply(const std::filesystem::path& path);
LoadedSurface read_obj(const std::filesystem::path& path);
LoadedSurface read_vtp(const std::filesystem::path& path);
std::string ply_text(const geometry::TriMesh& mesh);
std::string vtp_text(const geometry::FacedSurface& surface);

/// A face of a file: what its name begins with says what it is.
geometry::Face face_named(std::int32_t id, const std::string& name);
/// One that its file does not name: 1 is the wall.
geometry::Face face_without_name(std::int32_t id);

/// Throws InvalidInput "cannot read FILE: WHAT".
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what);

/// Splits text into words at white space, without copying; numbers never depend on the locale.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}
  /// Empty at the end.
  std::string_view next() {
    const std::size_t start = rest_.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return rest_ = {};
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n", start), rest_.size());
    const std::string_view word = rest_.substr(start, end - start);
    rest_ = rest_.substr(end);
    return word;
  }
  /// The rest of the current line, and goes to the next.
  std::string_view line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view text = rest_.substr(0, end);
    rest_ = rest_.substr(std::min(end + 1, rest_.size()));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }
  bool empty() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// A whole word as a number; nothing when it is none. "nan" and "inf" are numbers here.
template <class T>
std::optional<T> number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// ASCII's letters in capitals.
std::string upper(std::string_view text);

}  // namespace ostia::io
