#pragma once
/// \file The bars above the views: tools, and the sizes that they work with.

class QMainWindow;

namespace ostia::workstation {

class CommandTable;
struct Desk;

void build_tool_bars(QMainWindow& window, const CommandTable& commands, Desk& desk);

}  // namespace ostia::workstation
