#pragma once
/// \file Commands about the beating heart.

namespace ostia::workstation {

class BeatingCase;
class CommandTable;
struct Desk;
class StudySeries;

void add_phase_commands(CommandTable& table, const Desk& desk, BeatingCase& beating);
void add_series_commands(CommandTable& table, const Desk& desk, StudySeries& series);

}  // namespace ostia::workstation
