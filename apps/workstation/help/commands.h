#pragma once
/// \file Commands that help.

namespace ostia::workstation {

class CommandTable;
class Help;

void add_help_commands(CommandTable& table, Help& help);

}  // namespace ostia::workstation
