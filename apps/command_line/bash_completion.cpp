#include "completion.h"

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

namespace ostia::command_line {
namespace {

/// A name for a shell's function.
std::string bash_function(const CommandDescription& program) {
  std::string name = "_" + program.words.front();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

void for_each_command(const CommandDescription& command,
                      const std::function<void(const CommandDescription&)>& say) {
  say(command);
  for (const CommandDescription& below : command.commands) for_each_command(below, say);
}

/// Where a word turns the command so far into one below it.
void write_words_of_commands(std::ostream& out, const CommandDescription& program) {
  if (program.commands.empty()) return;
  out << "  for ((i = 1; i < COMP_CWORD; ++i)); do\n    case \"$command ${COMP_WORDS[i]}\" in\n";
  for_each_command(program, [&](const CommandDescription& command) {
    if (command.words != program.words)
      out << "      '" << command.joined(" ") << "') command='" << command.joined(" ") << "' ;;\n";
  });
  out << "    esac\n  done\n";
}

/// What stands before a value: the command, then the option by any of its names. The program's own options
/// hold for all of its commands.
std::string before_value_of(const OptionDescription& option, const CommandDescription& command,
                            const CommandDescription& program) {
  const std::string start = command.words == program.words ? "*' " : "'" + command.joined(" ") + " ";
  std::string patterns;
  for (const std::string& name : option.names)
    patterns += (patterns.empty() ? "" : " | ") + start + name + "'";
  return patterns;
}

/// What is done there: the few words that are taken, files, or nothing where it is a number.
std::string values_of(const OptionDescription& option) {
  if (option.takes_path()) return "";
  if (option.choices.empty()) return "compopt +o default; ";
  std::string words;
  for (const std::string& word : option.choices) words += (words.empty() ? "" : " ") + word;
  return "COMPREPLY=($(compgen -W '" + words + "' -- \"$now\")); ";
}

void write_values(std::ostream& out, const CommandDescription& program) {
  out << "  case \"$command $before\" in\n";
  for_each_command(program, [&](const CommandDescription& command) {
    for (const OptionDescription& option : command.options)
      if (!option.positional() && !option.value.empty())
        out << "    " << before_value_of(option, command, program) << ") " << values_of(option)
            << "return ;;\n";
  });
  out << "  esac\n";
}

void write_names(std::ostream& out, const CommandDescription& program) {
  const auto options_of = [](const CommandDescription& command) {
    std::string names;
    for (const OptionDescription& option : command.options)
      if (!option.positional())
        for (const std::string& name : option.names) names += (names.empty() ? "" : " ") + name;
    return names;
  };
  out << "  local options='" << options_of(program) << "' commands=''\n  case \"$command\" in\n";
  for_each_command(program, [&](const CommandDescription& command) {
    out << "    '" << command.joined(" ") << "')";
    if (command.words != program.words) out << " options+=' " << options_of(command) << "'";
    std::string commands;
    for (const CommandDescription& below : command.commands)
      commands += (commands.empty() ? "" : " ") + below.words.back();
    if (!commands.empty()) out << " commands='" << commands << "'";
    out << " ;;\n";
  });
  out << "  esac\n";
}

}  // namespace

std::string bash_completion(const CommandDescription& program) {
  const std::string name = program.words.front();
  std::ostringstream out;
  out << "# Completion of " << name << " for bash, made of the program's own options.\n"
      << bash_function(program) << "() {\n"
      << "  local now=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD - 1]}\" command='"
      << name << "' i\n  COMPREPLY=()\n";
  write_words_of_commands(out, program);
  write_values(out, program);
  write_names(out, program);
  out << R"(  if [[ $now == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$now"))
  elif [[ -n $commands ]]; then
    COMPREPLY=($(compgen -W "$commands" -- "$now"))
  fi
}
complete -o bashdefault -o default -F )"
      << bash_function(program) << " " << name << "\n";
  return out.str();
}

}  // namespace ostia::command_line
