#pragma once
/// \file Commands of the page that shows a vessel tree.

namespace ostia::workstation {

class CommandTable;
class TreeOpening;

void add_tree_commands(CommandTable& table, TreeOpening& trees);

}  // namespace ostia::workstation
