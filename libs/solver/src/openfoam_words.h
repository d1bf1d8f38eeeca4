#pragma once
/// \file OpenFOAM's ASCII files word by word.

#include "ostia/core/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace ostia::solver {

/// Words, and each of `{}();` alone; comments are skipped.
class OpenfoamWords {
 public:
  OpenfoamWords(const std::string& text, const std::filesystem::path& file) : text_(text), file_(file) {}

  /// Empty at the end.
  std::string_view next() {
    skip();
    if (at_ >= text_.size()) return {};
    const std::size_t from = at_++;
    if (special(text_[from])) return view(from);
    if (text_[from] == '"') {
      while (at_ < text_.size() && text_[at_] != '"') ++at_;
      at_ = std::min(at_ + 1, text_.size());
      return view(from);
    }
    while (at_ < text_.size() && !blank(text_[at_]) && !special(text_[at_])) ++at_;
    return view(from);
  }
  std::string_view peek() {
    const std::size_t at = at_;
    const std::string_view word = next();
    at_ = at;
    return word;
  }
  void expect(std::string_view wanted) {
    const std::string_view got = next();
    if (got != wanted) refuse("\"" + std::string(wanted) + "\" is expected, not \"" + shown(got) + "\"");
  }
  double number() {
    const std::string_view word = next();
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      refuse("\"" + shown(word) + "\" is no finite number; did the run diverge?");
    return value;
  }
  /// Up to the end of an entry, with what it has in brackets.
  void skip_entry() {
    int depth = 0;
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (word == "{" || word == "(") ++depth;
      if (word == "}" || word == ")") --depth;
      if (depth == 0 && (word == ";" || word == "}")) return;
    }
    refuse("the file ends within an entry");
  }
  [[noreturn]] void refuse(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InvalidInput("cannot read " + file_.string() + ": line " + std::to_string(line) + ": " + what);
  }

 private:
  static bool special(char c) { return c == '{' || c == '}' || c == '(' || c == ')' || c == ';'; }
  static bool blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  static std::string shown(std::string_view word) { return std::string(word.substr(0, 40)); }
  std::string_view view(std::size_t from) const { return std::string_view(text_).substr(from, at_ - from); }
  void skip() {
    while (at_ < text_.size()) {
      if (blank(text_[at_])) {
        ++at_;
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }
  const std::string& text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
};

}  // namespace ostia::solver
