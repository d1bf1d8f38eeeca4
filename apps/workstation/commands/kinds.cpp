#include "commands/kinds.h"

#include "shell/bind.h"
#include "shell/desk.h"

#include <QActionGroup>
#include <string>

namespace ostia::workstation {

Command tool_command(Command command, session::Tool tool, Desk& desk, QActionGroup& group) {
  command.id = QString::fromStdString("tool." + std::string(session::traits_of(tool).name));
  command.run = [&desk, tool, tip = command.tip] {
    desk.messages.say(tip);
    desk.bench.tool.set(tool);  // who watches it may have something better to say
  };
  command.bind = [&desk, &group, tool](QAction& action) {
    bind_value(&action, desk.bench.tool, tool);
    group.addAction(&action);
  };
  return command;
}

Command needs_case(Command command, const Desk& desk) {
  command.enabled = [&desk] { return desk.bench.has_case(); };
  command.why_not = [] { return Command::tr("No case is open."); };
  return command;
}

}  // namespace ostia::workstation
