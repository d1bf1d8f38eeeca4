#include "man_page.h"

#include "ostia/core/version.h"

#include <algorithm>
#include <sstream>

namespace ostia::command_line {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : between) + word;
  return line;
}

/// As it reads, whatever it is made of.
std::string plain(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == '-')
      line += "\\-";
    else if (c == '\\')
      line += "\\e";
    else
      line += c;
  }
  return !line.empty() && (line.front() == '.' || line.front() == '\'') ? "\\&" + line : line;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

void write_synopsis(std::ostream& out, const CommandDescription& command) {
  out << ".SH SYNOPSIS\n" << bold(command.joined(" "));
  if (!command.commands.empty()) out << " " << italic("COMMAND") << " ...";
  for (const OptionDescription& option : command.options) {
    if (option.positional())
      out << (option.required ? " " : " [") << italic(option.names.front()) << (option.repeats ? " ..." : "")
          << (option.required ? "" : "]");
    else if (option.required)
      out << " " << bold(option.names.front()) << " " << italic(option.value);
  }
  out << " [" << italic("OPTION") << " ...]\n";
}

void write_option(std::ostream& out, const OptionDescription& option) {
  out << ".TP\n";
  if (option.positional()) {
    out << italic(option.names.front());
  } else {
    for (std::size_t i = 0; i < option.names.size(); ++i) out << (i ? ", " : "") << bold(option.names[i]);
    if (!option.value.empty()) out << " " << italic(option.value);
  }
  out << "\n" << plain(option.text) << ".\n";
  if (!option.choices.empty()) out << "One of " << plain(joined(option.choices, ", ")) << ".\n";
  if (!option.limits.empty()) out << "Its value is " << plain(option.limits) << ".\n";
  if (option.required && !option.positional()) out << "Required.\n";
}

void write_options(std::ostream& out, const std::string& heading, const CommandDescription& command,
                   bool positional) {
  const bool any = std::any_of(command.options.begin(), command.options.end(),
                               [&](const OptionDescription& o) { return o.positional() == positional; });
  if (!any) return;
  out << ".SH " << heading << "\n";
  for (const OptionDescription& option : command.options)
    if (option.positional() == positional) write_option(out, option);
}

void write_commands(std::ostream& out, const CommandDescription& command) {
  if (command.commands.empty()) return;
  out << ".SH COMMANDS\n";
  for (const CommandDescription& below : command.commands)
    out << ".TP\n"
        << bold(below.words.back()) << "\n"
        << plain(below.text) << ".\nSee " << bold(below.joined("-")) << "(1).\n";
}

constexpr const char* exit_status = R"(.SH EXIT STATUS
.TP
.B 0
Done.
.TP
.B 2
Wrong usage.
.TP
.B 3
The input is not acceptable; the same call will fail again.
.TP
.B 4
Done, but a check of quality failed: a person must look.
.TP
.B 5
Memory, disk or time did not suffice.
.TP
.B 6
An internal error of the program.
)";

void write_see_also(std::ostream& out, const CommandDescription& command, const CommandDescription& program) {
  std::vector<std::string> pages;
  if (command.words != program.words) pages.push_back(program.joined("-"));
  for (const char* page : {"ostia", "ostia-live", "ostia-workstation"})
    if (page != command.joined("-") && std::find(pages.begin(), pages.end(), page) == pages.end())
      pages.emplace_back(page);
  out << ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i) out << (i ? ", " : "") << bold(pages[i]) << "(1)";
  out << "\n.PP\nThe package ostia\\-doc has the methods, formats and tutorials.\n";
}

}  // namespace

std::string man_page(const CommandDescription& command, const CommandDescription& program) {
  std::ostringstream out;
  const std::string name = command.joined("-");
  out << ".\\\" Made of the program's own descriptions of its options.\n"
      << ".TH " << plain(in_capitals(name)) << " 1 \"\" \"Ostia " << core::version() << "\" \"Ostia\"\n"
      << ".SH NAME\n"
      << plain(name) << " \\- " << plain(command.text) << "\n";
  write_synopsis(out, command);
  out << ".SH DESCRIPTION\n" << plain(command.text) << ".\n";
  if (command.words != program.words)
    out << "Options of " << bold(program.joined("-")) << "(1), such as " << bold("--threads")
        << ", may be given here, too.\n";
  write_commands(out, command);
  write_options(out, "ARGUMENTS", command, true);
  write_options(out, "OPTIONS", command, false);
  if (!command.examples.empty()) {
    out << ".SH EXAMPLES\n.nf\n";
    std::istringstream lines(command.examples);
    for (std::string line; std::getline(lines, line);) out << plain(line) << "\n";
    out << ".fi\n";
  }
  out << exit_status;
  write_see_also(out, command, program);
  return out.str();
}

}  // namespace ostia::command_line
