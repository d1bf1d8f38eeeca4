#include "help/commands.h"

#include "commands/table.h"
#include "help/crash_reports.h"
#include "help/help.h"

namespace ostia::workstation {

void add_help_commands(CommandTable& table, Help& help) {
  table.add(
      {.id = "help.find_command",
       .text = Command::tr("&Find a command\u2026"),
       .tip = Command::tr("Type what you want to do; shows the command, its key and its menu, and runs it."),
       .keys = {"Ctrl+K"},
       .run = [&help] { help.show_palette(); }});
  table.add({.id = "help.manual",
             .text = Command::tr("&Manual"),
             .tip = Command::tr("The user's manual; needs no network."),
             .keys = {"Shift+F1"},
             .run = [&help] { help.show_manual(); }});
  table.add({.id = "help.shortcuts",
             .text = Command::tr("&Keys and mouse"),
             .tip = Command::tr("All keys and mouse gestures, to be searched."),
             .keys = {"F1"},
             .run = [&help] { help.show_shortcuts(); }});
  table.add({.id = "help.tour",
             .text = Command::tr("&Tour"),
             .tip = Command::tr("Goes through the parts of the window."),
             .run = [&help] { help.show_tour(); }});
  table.add({.id = "help.about",
             .text = Command::tr("&About Ostia"),
             .tip = Command::tr("Version, licences, and what the program is not."),
             .run = [&help] { help.show_about(); }});
}

void add_crash_commands(CommandTable& table, CrashReports& reports) {
  table.add(
      {.id = "help.crash_reports",
       .text = Command::tr("&Reports of crashes\u2026"),
       .tip = Command::tr("What the program wrote down when it ended by itself; on this computer alone."),
       .run = [&reports] { reports.show(); },
       .enabled = [&reports] { return reports.any(); },
       .why_not = [] { return Command::tr("There is none."); }});
}

}  // namespace ostia::workstation
