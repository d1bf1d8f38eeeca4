#pragma once
/// \file Kinds of commands that several parts of the window have: tools, and what needs a case.

#include "commands/command.h"

#include "ostia/session/workbench.h"

class QActionGroup;

namespace ostia::workstation {

struct Desk;

/// Chooses what the mouse does in the views and says it in the status line. Of those in `group` one is
/// chosen. Its id is the tool's: "tool.brush".
Command tool_command(Command command, session::Tool tool, Desk& desk, QActionGroup& group);

/// Can be used while a case is open.
Command needs_case(Command command, const Desk& desk);

}  // namespace ostia::workstation
