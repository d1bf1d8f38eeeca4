#include "phases/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "phases/beating_case.h"
#include "shell/desk.h"

#include <utility>

namespace ostia::workstation {

void add_phase_commands(CommandTable& table, const Desk& desk, BeatingCase& beating) {
  const auto needs_motion = [&beating](Command command) {
    command.enabled = [&beating] { return beating.shown(); };
    command.why_not = [] { return Command::tr("No motion is open."); };
    return command;
  };
  table.add(needs_case({.id = "file.motion",
                        .text = Command::tr("Open a mo&tion\u2026"),
                        .tip = Command::tr("Shows the case beating: a motion that was fitted to its phases."),
                        .keys = {"Ctrl+Shift+B"},
                        .run = [&beating] { beating.ask(); }},
                       desk));
  table.add(needs_motion(
      {.id = "view.play",
       .text = Command::tr("&Play the heartbeat"),
       .tip = Command::tr("Plays the phases of the heart in all views, or pauses; needs a motion."),
       .keys = {"Ctrl+Space"},
       .run = [&beating] { beating.toggle(); }}));
  table.add(needs_motion(
      {.id = "view.own_phase",
       .text = Command::tr("Back to the case's phase"),
       .tip = Command::tr("Shows the phase that the case is of again, at which it can be edited."),
       .keys = {"Ctrl+Shift+Space"},
       .run = [&beating] { beating.go_to_own(); }}));
  QObject::connect(&beating, &BeatingCase::shown_changed, &table, &CommandTable::refresh);
}

}  // namespace ostia::workstation
