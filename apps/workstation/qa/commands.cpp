#include "qa/commands.h"

#include "commands/table.h"
#include "qa/dock.h"

namespace ostia::workstation {

void add_qa_commands(CommandTable& table, QaDock& dock) {
  table.add({.id = "view.qa",
             .text = Command::tr("&QA mode"),
             .tip = Command::tr("Holds the case against contours that somebody else knows to be right."),
             .action = dock.toggleViewAction()});
}

}  // namespace ostia::workstation
