#include "qa/commands.h"

#include "commands/table.h"
#include "qa/panel.h"

namespace ostia::workstation {

void add_qa_commands(CommandTable& table, QaPanel& panel) {
  table.add({.id = "view.qa",
             .text = Command::tr("&QA mode"),
             .tip = Command::tr("Holds the case against contours that somebody else knows to be right."),
             .action = panel.toggleViewAction()});
}

}  // namespace ostia::workstation
