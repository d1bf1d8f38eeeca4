#include "phases/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "phases/beating_case.h"
#include "phases/series_strip.h"
#include "phases/study_series.h"
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

void add_series_commands(CommandTable& table, const Desk& desk, StudySeries& series) {
  const auto needs_several = [&series](Command command) {
    command.enabled = [&series] { return series.any(); };
    command.why_not = [] { return Command::tr("There is no other series of the study."); };
    return command;
  };
  const auto needs_phases = [&series](Command command) {
    command.enabled = [&series] { return series.has_cine(); };
    command.why_not = [] { return Command::tr("There are no phases of one grid."); };
    return command;
  };
  Command beside{
      .id = "file.phases",
      .text = Command::tr("Phases from a folder\u2026"),
      .tip = Command::tr("More images of this heart: files of phases, or series of the same study."),
      .run = [&series] { series.ask_beside(); }};
  beside.enabled = [&desk] { return desk.bench.image().volume != nullptr; };
  beside.why_not = [] { return Command::tr("No image is open."); };
  table.add(beside);
  table.add(
      needs_several({.id = "view.series",
                     .text = Command::tr("Series of the study"),
                     .tip = Command::tr("Shows or hides the strip with a picture of each series and phase."),
                     .run = [&series] { series.show_or_hide(); }}));
  table.add(
      needs_several({.id = "view.own_series",
                     .text = Command::tr("Back to the image on the table"),
                     .tip = Command::tr("Shows the image that the case is of again, on which it is edited."),
                     .run = [&series] { series.go_to_own(); }}));
  table.add(needs_phases({.id = "view.series_play",
                          .text = Command::tr("Play the phases"),
                          .tip = Command::tr("Shows the phases of the study one after the other, or pauses."),
                          .run = [&series] { series.toggle_cine(); }}));
  table.add(needs_phases(
      {.id = "view.best_phase",
       .text = Command::tr("Find the sharpest phase"),
       .tip = Command::tr("Measures at which phase the arteries, or the heart, have the sharpest edges."),
       .run = [&series] { series.find_best(); }}));
  QObject::connect(&series, &StudySeries::changed, &table, &CommandTable::refresh);
}

}  // namespace ostia::workstation
