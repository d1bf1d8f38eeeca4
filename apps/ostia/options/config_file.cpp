#include "options/config_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::app {
namespace {

using nlohmann::json;

std::string text_of(const json& value, const std::string& file, const std::string& name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  throw InvalidInput("cannot use " + file + ": the member \"" + name +
                     "\" must be a text, a number, true, false or an array of them");
}

bool given(const std::vector<std::string>& arguments, const std::string& option) {
  return std::any_of(arguments.begin(), arguments.end(),
                     [&](const std::string& a) { return a == option || a.starts_with(option + "="); });
}

}  // namespace

std::vector<std::string> with_config(std::vector<std::string> arguments) {
  const auto at = std::find(arguments.begin(), arguments.end(), "--config");
  std::string file;
  if (at != arguments.end() && at + 1 != arguments.end()) {
    file = *(at + 1);
    arguments.erase(at, at + 2);
  } else {
    const auto joined = std::find_if(arguments.begin(), arguments.end(),
                                     [](const std::string& a) { return a.starts_with("--config="); });
    if (joined == arguments.end()) return arguments;
    file = joined->substr(9);
    arguments.erase(joined);
  }
  const json config = json::parse(core::read_file(file, 16 << 20), nullptr, false);
  if (config.is_discarded() || !config.is_object())
    throw InvalidInput("cannot use " + file + ": it must hold one JSON object, such as {\"threads\": 2}");
  const std::vector<std::string> typed = arguments;
  for (const auto& [name, value] : config.items()) {
    const std::string option = "--" + name;
    if (name == "v" || given(typed, option)) continue;
    if (value.is_boolean()) {
      if (value.get<bool>()) arguments.push_back(option);
      continue;
    }
    for (const json& one : value.is_array() ? value : json::array({value})) {
      arguments.push_back(option + "=" + text_of(one, file, name));
    }
  }
  return arguments;
}

}  // namespace ostia::app
