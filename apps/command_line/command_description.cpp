#include "command_description.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <sstream>

namespace ostia::command_line {
namespace {

/// CLI11 writes "TEXT:{lps,ras,ijk}" or "FLOAT:above 0": the kind of the value, then what is checked.
void read_value(const std::string& type, OptionDescription& option) {
  const auto colon = type.find(':');
  option.value = type.substr(0, colon);
  if (colon == std::string::npos) return;
  const std::string checked = type.substr(colon + 1);
  const auto open = checked.find('{'), close = checked.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open) {
    const std::string kind = option.value + " ";  // "INT in [0 - 10]"
    option.limits = checked.starts_with(kind) ? checked.substr(kind.size()) : checked;
    return;
  }
  std::istringstream words(checked.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');) option.choices.push_back(word);
}

/// Of a flag that stands for a word, "--uncertainty{usual}"; "!--no-search" stands for false, and takes
/// nothing.
bool is_flag_or_value(const CLI::Option& given) {
  if (given.get_fnames().empty()) return false;
  const std::string stands_for = given.get_flag_value(given.get_fnames().front(), "");
  return stands_for != "true" && stands_for != "false";
}

OptionDescription describe(const CLI::Option& given) {
  OptionDescription option;
  for (const std::string& name : given.get_snames()) option.names.push_back("-" + name);
  for (const std::string& name : given.get_lnames()) option.names.push_back("--" + name);
  if (option.names.empty()) option.names.push_back(given.get_single_name());
  if (given.get_items_expected_max() > 0) {
    read_value(given.get_type_name(), option);
    if (option.value.empty()) option.value = "TEXT";  // it is read by no variable
  }
  option.text = given.get_description();
  option.required = given.get_required();
  option.repeats = given.get_items_expected_max() > 1;
  option.flag_or_value = is_flag_or_value(given);
  return option;
}

/// The examples, without their heading.
std::string examples_of(const std::string& footer) {
  std::istringstream lines(footer);
  std::string examples;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Example:" || line == "Examples:") continue;
    const auto text = line.find_first_not_of(' ');
    examples += (text == std::string::npos ? "" : line.substr(text)) + "\n";
  }
  return examples;
}

CommandDescription describe(const CLI::App& app, std::vector<std::string> words) {
  CommandDescription command;
  words.push_back(app.get_name());
  command.words = words;
  command.text = app.get_description();
  while (!command.text.empty() && command.text.back() == '.') command.text.pop_back();
  command.examples = examples_of(app.get_footer());
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) command.options.push_back(describe(*option));
  for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!below->get_group().empty()) command.commands.push_back(describe(*below, words));
  return command;
}

}  // namespace

bool OptionDescription::takes_path() const {
  return choices.empty() && !value.empty() && value != "INT" && value != "UINT" && value != "FLOAT";
}

std::string CommandDescription::joined(const char* between) const {
  std::string line = words.front();
  for (auto word = words.begin() + 1; word != words.end(); ++word) line += between + *word;
  return line;
}

CommandDescription describe(const CLI::App& app) {
  return describe(app, {});
}

}  // namespace ostia::command_line
