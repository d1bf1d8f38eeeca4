#pragma once
/// \file Commands that measure, and that make the report.

class QActionGroup;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Reporting;

void add_measuring_commands(CommandTable& table, Desk& desk, Reporting& reporting, QActionGroup& tools);

}  // namespace ostia::workstation
