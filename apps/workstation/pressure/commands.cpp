#include "pressure/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "pressure/live.h"
#include "pressure/page.h"
#include "pressure/saving.h"
#include "shell/bind.h"
#include "shell/desk.h"

namespace ostia::workstation {
namespace {

/// Can be used while the page is open, a vessel is selected, and the case can be edited.
Command needs_page(Command command, const Desk& desk, Pressures& pressures) {
  command.why_not = [&desk, &pressures]() -> QString {
    if (!desk.bench.has_case()) return Command::tr("No case is open.");
    if (!pressures.board().shown.get()) return Command::tr("The page Pressure is not open.");
    return desk.bench.axis() ? QString() : Command::tr("No vessel is selected.");
  };
  command.enabled = [why_not = command.why_not] { return why_not().isEmpty(); };
  return command;
}

}  // namespace

void add_pressure_commands(CommandTable& table, Desk& desk, Pressures& pressures, PressurePage& page) {
  table.add({.id = "view.pressure",
             .text = Command::tr("&Pressure (research)"),
             .tip = Command::tr("Computes pressure and flow along the tree, and shows FFR in all views."),
             .keys = {"Ctrl+Alt+P"},
             .action = page.toggleViewAction()});
  table.add({.id = "pressure.map",
             .text = Command::tr("&Colour the tree by FFR"),
             .tip = Command::tr("While the page Pressure is open."),
             .bind = [&pressures](QAction& action) { bind_checked(&action, pressures.map); }});
  table.add(needs_page({.id = "pressure.open",
                        .text = Command::tr("What if it were &opened"),
                        .tip = Command::tr("FFR as if the narrowing at the cursor had its reference calibre, "
                                           "less what stays; the lumen is as it was."),
                        .run = [&pressures] { pressures.open_at_cursor(); }},
                       desk, pressures));
  table.add(
      needs_page({.id = "pressure.narrow",
                  .text = Command::tr("What if it were &narrower"),
                  .tip = Command::tr("FFR as if the stretch at the cursor were narrowed by a stenosis of "
                                     "this percent; the lumen is as it was."),
                  .run = [&pressures] { pressures.narrow_at_cursor(); }},
                 desk, pressures));
  Command clear = needs_page({.id = "pressure.clear",
                              .text = Command::tr("&Take all of them back"),
                              .tip = Command::tr("FFR of the lumen as it is alone."),
                              .run = [&pressures] { pressures.board().clear_what_ifs(); }},
                             desk, pressures);
  clear.enabled = [&pressures] { return !pressures.board().notes().what_ifs.empty(); };
  clear.why_not = [] { return Command::tr("Nothing is looked at as if it were otherwise."); };
  table.add(clear);
  auto* saving = new PressureSaving(desk, pressures);
  Command report = needs_page({.id = "pressure.report",
                               .text = Command::tr("Report of the p&ressures"),
                               .tip = Command::tr("PDF, HTML and tables of inputs, curves and readings, in a "
                                                  "folder beside the case."),
                               .run = [&desk, saving] { saving->save(desk.case_path); }},
                              desk, pressures);
  report.enabled = [&pressures] { return pressures.board().shown.get() && pressures.board().now(); };
  report.why_not = [] { return Command::tr("The page Pressure is not open, or knows no pressures yet."); };
  table.add(report);
  keep_with(&table, pressures.board().shown.observe([&table](const bool&) { table.refresh(); }));
  keep_with(&table, pressures.board().changed.observe([&table, &pressures, known = false]() mutable {
    if (known == (pressures.board().now() != nullptr)) return;
    known = !known;
    table.refresh();
  }));
}

}  // namespace ostia::workstation
