#pragma once
/// \file Commands of computed pressures.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class PressurePage;
class Pressures;

void add_pressure_commands(CommandTable& table, Desk& desk, Pressures& pressures, PressurePage& page);

}  // namespace ostia::workstation
