#include "ostia/solver/openfoam_result.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/io/openfoam_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

using Words = io::OpenfoamWords;

double value_in(Words& words) {
  const std::string_view word = words.next();
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    words.refuse("\"" + Words::shown(word) + "\" is no finite number; did the run diverge?");
  return value;
}

void read_value(Words& words, std::size_t components, std::vector<double>& out) {
  if (components == 3) words.expect("(");
  for (std::size_t c = 0; c < components; ++c) out.push_back(value_in(words));
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
    const double told = value_in(words);
    if (told != static_cast<double>(count))
      words.refuse("it has " + core::shortest_text(told) + " values where the mesh has " +
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
  Words words(file);
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

std::vector<OpenfoamTime> times_of(const fs::path& case_folder) {
  std::error_code error;
  std::vector<OpenfoamTime> times;
  for (const auto& entry : fs::directory_iterator(case_folder, error)) {
    const std::string name = entry.path().filename().string();
    double time = 0.0;
    const auto [end, bad] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (bad == std::errc() && end == name.data() + name.size() && time > 0.0)
      times.push_back({time, entry.path()});
  }
  if (error) throw IoError("cannot read " + case_folder.string() + ": " + error.message());
  std::ranges::sort(times, {}, &OpenfoamTime::time);
  return times;
}

fs::path last_time(const fs::path& case_folder) {
  const std::vector<OpenfoamTime> times = times_of(case_folder);
  if (times.empty()) throw InvalidInput(case_folder.string() + " holds no result: run ./Allrun there first");
  return times.back().folder;
}

}  // namespace ostia::solver
