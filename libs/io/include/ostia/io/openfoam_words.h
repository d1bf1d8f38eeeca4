#pragma once
/// \file OpenFOAM's ASCII files word by word.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::io {

/// Words, "texts" as one word, and each of `{}();` alone; comments are skipped. Words are views into the
/// file's text, which lives as long as this.
class OpenfoamWords {
 public:
  /// Throws IoError where the file cannot be read.
  explicit OpenfoamWords(std::filesystem::path file);
  OpenfoamWords(const OpenfoamWords&) = delete;
  OpenfoamWords& operator=(const OpenfoamWords&) = delete;

  /// Empty at the end.
  std::string_view next();
  std::string_view peek();
  /// Throws InvalidInput where another word comes next.
  void expect(std::string_view wanted);
  /// Up to the end of an entry, with what it has in brackets. Throws InvalidInput where the file ends in it.
  void skip_entry();
  /// Throws InvalidInput "cannot read FILE: line N: WHAT", the line where the last word ends.
  [[noreturn]] void refuse(const std::string& what) const;

  /// A word as a message shows it: at most 40 characters.
  static std::string shown(std::string_view word) { return std::string(word.substr(0, 40)); }

  std::size_t bytes() const { return text_.size(); }

 private:
  std::string_view word_from(std::size_t start) const;
  void skip_blank();
  std::filesystem::path file_;
  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace ostia::io
