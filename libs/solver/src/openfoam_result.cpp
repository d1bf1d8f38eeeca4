#include "ostia/solver/openfoam_result.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

/// Words, and each of `{}();` alone; comments are skipped.
class Words {
 public:
  Words(const std::string& text, const fs::path& file) : text_(text), file_(file) {}

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
        const std::size_t end = text_.find("*/", at_);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }
  const std::string& text_;
  const fs::path& file_;
  std::size_t at_ = 0;
};

void read_value(Words& words, std::size_t components, std::vector<double>& out) {
  if (components == 3) words.expect("(");
  for (std::size_t c = 0; c < components; ++c) out.push_back(words.number());
  if (components == 3) words.expect(")");
}

/// `uniform v;` or `nonuniform List<...> n (...);`
std::vector<double> read_values(Words& words, std::size_t components, std::size_t count) {
  std::vector<double> values;
  const std::string_view how = words.next();
  if (how == "uniform") {
    std::vector<double> one;
    read_value(words, components, one);
    for (std::size_t i = 0; i < count; ++i) values.insert(values.end(), one.begin(), one.end());
  } else if (how == "nonuniform") {
    words.next();  // List<...>
    const double told = words.number();
    if (told != static_cast<double>(count))
      words.refuse("it has " + std::to_string(static_cast<long long>(told)) + " values where the mesh has " +
                   std::to_string(count) + "; was the case made of another mesh?");
    words.expect("(");
    values.reserve(count * components);
    for (std::size_t i = 0; i < count; ++i) read_value(words, components, values);
    words.expect(")");
  } else {
    words.refuse("values that are neither uniform nor nonuniform");
  }
  words.expect(";");
  return values;
}

std::size_t components_of(Words& words) {
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "format" && words.peek() != "ascii")
      words.refuse("it is binary; set `writeFormat ascii` in system/controlDict");
    if (word == "volScalarField") return 1;
    if (word == "volVectorField") return 3;
  }
  words.refuse("it is no volScalarField and no volVectorField");
}

void read_patch(Words& words, const std::string& name, const std::map<std::string, std::size_t>& facets,
                OpenfoamField& field) {
  words.expect("{");
  while (words.peek() != "}") {
    const std::string_view key = words.next();
    if (key.empty()) words.refuse("the file ends within a patch");
    const auto known = facets.find(name);
    if (key == "value" && known != facets.end())
      field.patches[name] = read_values(words, field.components, known->second);
    else
      words.skip_entry();
  }
  words.expect("}");
}

}  // namespace

double OpenfoamField::magnitude(const std::vector<double>& values, std::size_t i) const {
  double square = 0.0;
  for (std::size_t c = 0; c < components; ++c)
    square += values[components * i + c] * values[components * i + c];
  return std::sqrt(square);
}

OpenfoamField read_openfoam_field(const fs::path& file, std::size_t cells,
                                  const std::map<std::string, std::size_t>& facets) {
  const std::string text = core::read_file(file);
  Words words(text, file);
  OpenfoamField field;
  field.components = components_of(words);
  for (std::string_view word = words.next(); word != "internalField"; word = words.next())
    if (word.empty()) words.refuse("it has no internalField");
  field.cells = read_values(words, field.components, cells);
  words.expect("boundaryField");
  words.expect("{");
  while (words.peek() != "}") {
    const std::string name(words.next());
    if (name.empty()) words.refuse("the file ends within the boundaryField");
    read_patch(words, name, facets, field);
  }
  return field;
}

fs::path last_time(const fs::path& case_folder) {
  std::error_code error;
  fs::path last;
  double latest = 0.0;
  for (const auto& entry : fs::directory_iterator(case_folder, error)) {
    const std::string name = entry.path().filename().string();
    double time = 0.0;
    const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (bad != std::errc() || end != name.data() + name.size() || time <= latest) continue;
    latest = time;
    last = entry.path();
  }
  if (error) throw IoError("cannot read " + case_folder.string() + ": " + error.message());
  if (last.empty()) throw InvalidInput(case_folder.string() + " holds no result: run ./Allrun there first");
  return last;
}

}  // namespace ostia::solver
