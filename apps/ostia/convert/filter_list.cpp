#include "convert/filter_list.h"

#include "ostia/core/text.h"
#include "ostia/filtering/filter_list.h"

#include <nlohmann/json.hpp>

namespace ostia::app {
namespace {

using Json = nlohmann::ordered_json;
using filtering::FilterFacts;
using filtering::ParameterFacts;

std::string range_text(const ParameterFacts& one) {
  std::string text;
  if (one.words.empty()) {
    text = core::shortest_text(one.least) + " to " + core::shortest_text(one.most);
    if (!one.unit.empty()) text += " " + one.unit;
    return text + ", default " + core::shortest_text(one.value);
  }
  for (const std::string& word : one.words) text += (text.empty() ? "" : ", ") + word;
  return text + ", default " + one.words[static_cast<std::size_t>(one.value)];
}

std::string needs_text(const FilterFacts& one) {
  std::string text;
  if (one.companion == filtering::Companion::mask) text += "; takes --mask";
  if (one.companion == filtering::Companion::reference) text += "; needs --reference";
  if (one.result == filtering::Result::mask) text += "; gives 0 and 1";
  if (one.result == filtering::Result::labels) text += "; gives labels";
  if (one.result == filtering::Result::own) text += "; gives " + one.unit;
  return text;
}

Json json_of(const ParameterFacts& one) {
  Json out{{"name", one.name}, {"text", one.text}, {"unit", one.unit}};
  if (one.words.empty()) {
    out["default"] = one.value;
    out["least"] = one.least;
    out["most"] = one.most;
    out["whole"] = one.whole;
  } else {
    out["default"] = one.words[static_cast<std::size_t>(one.value)];
    out["words"] = one.words;
  }
  return out;
}

}  // namespace

std::string filters_text() {
  std::string text;
  for (const FilterFacts& one : filtering::filters()) {
    text += one.name + ": " + one.text + needs_text(one) + " (" + one.itk + ")\n";
    for (const ParameterFacts& parameter : one.parameters)
      text += "  " + parameter.name + ": " + parameter.text + "; " + range_text(parameter) + "\n";
  }
  return text;
}

std::string filters_json() {
  Json all = Json::array();
  for (const FilterFacts& one : filtering::filters()) {
    Json parameters = Json::array();
    for (const ParameterFacts& parameter : one.parameters) parameters.push_back(json_of(parameter));
    all.push_back({{"name", one.name},
                   {"text", one.text},
                   {"itk", one.itk},
                   {"parameters", parameters},
                   {"values", name_of(one.result)},
                   {"unit", one.unit},
                   {"companion", name_of(one.companion)},
                   {"least_voxels", one.least_voxels},
                   {"bytes_per_voxel", one.bytes_per_voxel}});
  }
  return Json{{"v", 1}, {"kind", "filters"}, {"filters", all}}.dump(2) + "\n";
}

}  // namespace ostia::app
