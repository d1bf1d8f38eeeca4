#pragma once
/// \file The commands of the calcium score.

namespace ostia::workstation {

class Calcium;
class CalciumPage;
class CommandTable;
struct Desk;

void add_calcium_commands(CommandTable& table, Desk& desk, Calcium& calcium, CalciumPage& page);

}  // namespace ostia::workstation
