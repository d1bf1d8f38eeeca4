#pragma once
/// \file Commands that open, copy and close cases and images.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Opening;
class Orientation;

void add_opening_commands(CommandTable& table, const Desk& desk, Opening& opening, Orientation& orientation);

}  // namespace ostia::workstation
