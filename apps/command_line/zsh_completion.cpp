#include "completion.h"

#include <algorithm>
#include <sstream>

namespace ostia::command_line {
namespace {

std::string zsh_function(const CommandDescription& command) {
  std::string name = "_" + command.joined("_");
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Inside single quotes and a specification of _arguments, where brackets and colons mean something.
std::string in_specification(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\'')
      safe += "'\\''";
    else if (c == '[' || c == ']' || c == ':' || c == '\\')
      safe += std::string("\\") + c;
    else
      safe += c;
  }
  return safe;
}

std::string action_of(const OptionDescription& option) {
  if (option.takes_path()) return "_files";
  if (option.choices.empty()) return " ";
  std::string words = "(";
  for (std::size_t i = 0; i < option.choices.size(); ++i)
    words += (i ? " " : "") + in_specification(option.choices[i]);
  return words + ")";
}

/// One line of _arguments a name.
void write_specification(std::ostream& out, const OptionDescription& option) {
  const std::string value =
      option.value.empty() ? "" : ":" + in_specification(option.value) + ":" + action_of(option);
  for (const std::string& name : option.names)
    out << "    '" << (option.repeats ? "*" : "") << name << "[" << in_specification(option.text) << "]"
        << value << "' \\\n";
}

bool has_option(const CommandDescription& command, const std::string& name) {
  return std::any_of(command.options.begin(), command.options.end(), [&](const OptionDescription& option) {
    return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
  });
}

void write_function(std::ostream& out, const CommandDescription& command, const CommandDescription& program) {
  for (const CommandDescription& below : command.commands) write_function(out, below, program);
  out << zsh_function(command) << "() {\n";
  if (!command.commands.empty()) out << "  local line state\n";
  out << "  _arguments " << (command.commands.empty() ? "" : "-C ") << "\\\n";
  const bool whole = command.words == program.words;
  for (const OptionDescription& option : program.options)
    if (!option.positional() && (whole || !has_option(command, option.names.back())))
      write_specification(out, option);
  for (const OptionDescription& option : command.options)
    if (!option.positional() && !whole) write_specification(out, option);
  if (command.commands.empty()) {
    out << "    '*:file:_files'\n}\n\n";
    return;
  }
  out << "    '1:command:->command' \\\n    '*::argument:->argument'\n  case $state in\n    command)\n"
      << "      local -a commands=(\n";
  for (const CommandDescription& below : command.commands)
    out << "        '" << below.words.back() << ":" << in_specification(below.text) << "'\n";
  out << "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
  for (const CommandDescription& below : command.commands)
    out << "        " << below.words.back() << ") " << zsh_function(below) << " ;;\n";
  out << "      esac ;;\n  esac\n}\n\n";
}

}  // namespace

std::string zsh_completion(const CommandDescription& program) {
  std::ostringstream out;
  out << "#compdef " << program.words.front() << "\n# Made of the program's own options.\n\n";
  write_function(out, program, program);
  out << zsh_function(program) << " \"$@\"\n";
  return out.str();
}

}  // namespace ostia::command_line
