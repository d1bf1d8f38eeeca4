#include "options/shown_defaults.h"

#include "ostia/core/text.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace ostia::app {
namespace {

bool says_its_default(const std::string& text) {
  constexpr std::array<std::string_view, 3> words{"default", "left out", "unless given"};
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

bool is_nothing(const std::string& value) {
  constexpr std::array<std::string_view, 4> nothing{"", "\"\"", "[]", "{}"};
  return std::ranges::find(nothing, value) != nothing.end();
}

bool would_be_taken(CLI::Option& option, std::string value) {
  for (int i = 0;; ++i) {
    try {
      if (!(*option.get_validator(i))(value).empty()) return false;
    } catch (const CLI::OptionNotFound&) {
      return true;  // there are no more
    }
  }
}

void show_default(CLI::Option& option) {
  const std::string value = option.get_default_str(), text = option.get_description();
  option.default_str("");
  if (!is_nothing(value) && !text.empty() && !says_its_default(text) && would_be_taken(option, value))
    option.description(text + "; default " + value);
}

}  // namespace

std::string default_text(double value) {
  return "; default " + core::shortest_text(value);
}

void capture_defaults(CLI::App& app) {
  app.option_defaults()->always_capture_default();
}

void show_defaults(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->get_items_expected_max() > 0) show_default(*option);
  for (CLI::App* below : app.get_subcommands([](CLI::App*) { return true; })) show_defaults(*below);
}

}  // namespace ostia::app
