#pragma once
/// \file The command of the QA mode.

namespace ostia::workstation {

class CommandTable;
class QaDock;

void add_qa_commands(CommandTable& table, QaDock& dock);

}  // namespace ostia::workstation
