#pragma once
/// \file What a program can be asked, apart from the library that parses its command line: what manual pages
/// and completions are made of.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::command_line {

struct OptionDescription {
  std::vector<std::string> names;    ///< "-o", "--output"; one without dashes for a positional argument
  std::string value;                 ///< what it takes: "TEXT", "INT", "FILE"; empty: nothing
  std::vector<std::string> choices;  ///< the words that it takes, where these are all
  std::string limits;                ///< in words, "above 0", "in [0 - 10]"; may be empty
  std::string text;
  bool required = false;
  bool repeats = false;
  bool flag_or_value = false;  ///< a flag, so `value` is empty, that also takes a value: --name=VALUE

  bool positional() const { return names.front().front() != '-'; }
  /// Its value may be the name of a file or folder.
  bool takes_path() const;
};

struct CommandDescription {
  std::vector<std::string> words;  ///< "ostia", "evaluate", "lumen"
  std::string text;                ///< one sentence, without a full stop
  std::vector<OptionDescription> options;
  std::string examples;  ///< a shell's lines; may be empty
  std::vector<CommandDescription> commands;

  std::string joined(const char* between) const;  ///< words, "ostia-evaluate-lumen"
};

/// Of a whole program or of one of its commands. Options and commands of the group "" are left out.
CommandDescription describe(const CLI::App& app);

}  // namespace ostia::command_line
