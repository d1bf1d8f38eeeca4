#pragma once
/// \file Commands of the keyboard: from panel to panel, and the mouse by keys.

namespace ostia::workstation {

class CommandTable;
class Keyboard;

void add_keyboard_commands(CommandTable& table, Keyboard& keyboard);

}  // namespace ostia::workstation
