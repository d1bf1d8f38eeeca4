#include "ostia/io/openfoam_words.h"

#include "surface_formats.h"

#include "ostia/core/files.h"

#include <algorithm>
#include <utility>

namespace ostia::io {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_mark(char c) {
  return c == '(' || c == ')' || c == '{' || c == '}' || c == ';';
}

}  // namespace

OpenfoamWords::OpenfoamWords(std::filesystem::path file)
    : file_(std::move(file)), text_(core::read_file(file_)) {}

std::string_view OpenfoamWords::next() {
  skip_blank();
  if (at_ >= text_.size()) return {};
  const std::size_t start = at_++;
  if (is_mark(text_[start])) return word_from(start);
  if (text_[start] == '"') {
    while (at_ < text_.size() && text_[at_] != '"') ++at_;
    at_ = std::min(at_ + 1, text_.size());
    return word_from(start);
  }
  while (at_ < text_.size() && !is_blank(text_[at_]) && !is_mark(text_[at_])) ++at_;
  return word_from(start);
}

std::string_view OpenfoamWords::peek() {
  const std::size_t at = at_;
  const std::string_view word = next();
  at_ = at;
  return word;
}

void OpenfoamWords::expect(std::string_view wanted) {
  const std::string_view got = next();
  if (got != wanted) refuse("\"" + std::string(wanted) + "\" is expected, not \"" + shown(got) + "\"");
}

void OpenfoamWords::skip_entry() {
  int depth = 0;
  for (std::string_view word = next(); !word.empty(); word = next()) {
    if (word == "{" || word == "(") ++depth;
    if (word == "}" || word == ")") --depth;
    if (depth == 0 && (word == ";" || word == "}")) return;
  }
  refuse("the file ends within an entry");
}

void OpenfoamWords::refuse(const std::string& what) const {
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  io::refuse(file_, "line " + std::to_string(line) + ": " + what);
}

std::string_view OpenfoamWords::word_from(std::size_t start) const {
  return std::string_view(text_).substr(start, at_ - start);
}

void OpenfoamWords::skip_blank() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
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

}  // namespace ostia::io
