#pragma once
/// \file Commands of plug-ins: one for each, and those of their folder.

class QMenu;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Plugins;

void add_plugin_commands(CommandTable& table, Plugins& plugins);
/// Keeps a command for each plug-in in the table and at the head of the menu.
void list_plugins_in(QMenu& menu, CommandTable& table, Plugins& plugins);

}  // namespace ostia::workstation
