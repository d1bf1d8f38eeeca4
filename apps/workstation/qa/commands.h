#pragma once
/// \file The command of the QA mode.

namespace ostia::workstation {

class CommandTable;
class QaPanel;

void add_qa_commands(CommandTable& table, QaPanel& panel);

}  // namespace ostia::workstation
