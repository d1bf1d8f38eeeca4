#pragma once
/// \file Commands about the beating heart.

namespace ostia::workstation {

class BeatingCase;
class CommandTable;
struct Desk;

void add_phase_commands(CommandTable& table, const Desk& desk, BeatingCase& beating);

}  // namespace ostia::workstation
