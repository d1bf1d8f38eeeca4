#pragma once
/// \file Commands that help.

namespace ostia::workstation {

class CommandTable;
class CrashReports;
class Help;

void add_help_commands(CommandTable& table, Help& help);
void add_crash_commands(CommandTable& table, CrashReports& reports);

}  // namespace ostia::workstation
