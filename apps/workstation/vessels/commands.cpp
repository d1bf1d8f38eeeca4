#include "vessels/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "vessels/connect_menu.h"
#include "vessels/evaluability.h"
#include "vessels/finder.h"
#include "vessels/outer_walls.h"
#include "vessels/tips.h"

#include <QMenu>
#include <cmath>

namespace ostia::workstation {
namespace {

using session::Tool;
using session::Workbench;

void join_with_parent(Workbench& bench) {
  const std::int32_t vessel = bench.vessel.get();
  const double cursor = bench.cursor_mm.get();
  const auto parent = lumen::merge_parent(bench.model()->tree, vessel);
  bench.edit(lumen::BranchMerge{vessel});
  bench.vessel.set(*parent);  // the same place: its abscissas go on as they were
  bench.cursor_mm.set(cursor);
}

void ask_what_to_connect(const Desk& desk, Workbench& bench) {
  const Guard guard = [&desk](const std::function<void()>& act) { desk.messages.guarded(act); };
  connect_menu(bench, guard, &desk.window)->popup(desk.window.mapToGlobal(desk.window.rect().center()));
}

void change_size(Workbench& bench, double steps) {
  auto& property = bench.tool.get() == Tool::brush ? bench.brush_mm : bench.reach_mm;
  property.set(property.get() + steps * property.range()->step);
}

/// Why the selected vessel cannot be edited as a whole; empty where it can.
QString no_vessel(const Workbench& bench) {
  if (!bench.has_case()) return Command::tr("No case is open.");
  return bench.axis() ? QString() : Command::tr("No vessel is selected.");
}

QString no_other_vessel(const Workbench& bench) {
  const QString none = no_vessel(bench);
  if (!none.isEmpty() || bench.model()->vessels.size() > 1) return none;
  return Command::tr("The case has one vessel alone.");
}

QString no_parent(const Workbench& bench) {
  const QString none = no_vessel(bench);
  if (!none.isEmpty() || lumen::merge_parent(bench.model()->tree, bench.vessel.get())) return none;
  return Command::tr("This vessel does not go on from the end of another.");
}

QString nothing_to_find(const Workbench& bench) {
  if (bench.has_case()) return Command::tr("A case is open already: close it first.");
  return bench.image().volume ? QString() : Command::tr("No image is open.");
}

/// Can be used while `why_not` has nothing to say.
Command unless(Command command, const std::function<QString()>& why_not) {
  command.enabled = [why_not] { return why_not().isEmpty(); };
  command.why_not = why_not;
  return command;
}

void add_editing_tools(CommandTable& table, Desk& desk, QActionGroup& tools) {
  Workbench& bench = desk.bench;
  table.add(tool_command(
      {
          .text = Command::tr("Pull"),
          .tip = Command::tr("Take the contour and pull it. Shift and wheel: how far the pull reaches."),
          .keys = {"E", "W"},
      },
      Tool::drag, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Draw"),
          .tip = Command::tr("Draw the wall anew, on a CPR or around the lumen on the cross-section."),
          .keys = {"W", "D"},
      },
      Tool::draw, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Brush"),
          .tip = Command::tr("A ball that pushes the wall: outwards from within, inwards from without."),
          .keys = {"B"},
      },
      Tool::brush, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Centerline"),
          .tip =
              Command::tr("Pull the centerline. Double click adds a control point, Delete takes one away."),
          .keys = {"C"},
      },
      Tool::axis, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Add vessel"),
          .tip = Command::tr("Click the distal end of a vessel; the way back to the tree is found."),
          .keys = {"V", "A"},
      },
      Tool::add_vessel, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Add artery"),
          .tip = Command::tr("Click an artery's ostium, then its distal end: it begins a tree of its own."),
          .keys = {"Shift+V", "Shift+A"},
      },
      Tool::add_artery, desk, tools));
  table.add({.id = "tool.smaller",
             .text = Command::tr("Smaller ball, shorter reach"),
             .tip = Command::tr("Makes the brush's ball smaller, or the reach of a pull shorter."),
             .keys = {","},
             .run = [&bench] { change_size(bench, -1.0); }});
  table.add({.id = "tool.larger",
             .text = Command::tr("Larger ball, longer reach"),
             .tip = Command::tr("Makes the brush's ball larger, or the reach of a pull longer."),
             .keys = {"."},
             .run = [&bench] { change_size(bench, 1.0); }});
}

void add_wall_commands(CommandTable& table, OuterWalls& walls) {
  session::OuterWallBoard& board = walls.board();
  table.add({.id = "view.outer_wall",
             .text = Command::tr("Outer wall"),
             .tip = Command::tr("Looks for the outer wall of the selected vessel, draws it on the 2D views "
                                "and tells what plaque there is."),
             .bind = [&board](QAction& action) { bind_checked(&action, board.shown); }});
  table.add(unless({.id = "view.plaque",
                    .text = Command::tr("Plaque"),
                    .tip = Command::tr(
                        "Colours what lies between lumen and outer wall on sections and CPRs by its class."),
                    .keys = {"Shift+P"},
                    .bind = [&board](QAction& action) { bind_checked(&action, board.plaque_shown); }},
                   [&walls] { return walls.why_no_plaque(); }));
  keep_with(&table, board.changed.observe([&table] { table.refresh(); }));
}

void add_evaluability_commands(CommandTable& table, Evaluability& judging) {
  using Grade = analysis::Evaluability;
  const auto add = [&](const char* id, const QString& text, const char* keys, std::optional<Grade> grade) {
    table.add(unless({.id = id,
                      .text = text,
                      .tip = Command::tr("The stretch of the chosen measurement along the vessel or, without "
                                         "one, the stretch at the cursor."),
                      .keys = {keys},
                      .run = [&judging, grade] { judging.judge(grade); }},
                     [&judging] { return judging.why_not(); }));
  };
  add("vessel.evaluable", Command::tr("Judge: &evaluable"), "Ctrl+1", Grade::evaluable);
  add("vessel.limited", Command::tr("Judge: &limited"), "Ctrl+2", Grade::limited);
  add("vessel.not_evaluable", Command::tr("Judge: &not evaluable"), "Ctrl+3", Grade::not_evaluable);
  add("vessel.judged_by_program", Command::tr("Judge: as the &program finds it"), "Ctrl+4", std::nullopt);
  session::EvaluabilityBoard& board = judging.board();
  table.add(
      {.id = "view.evaluability",
       .text = Command::tr("Evaluability"),
       .tip = Command::tr("Marks beside CPRs and in the profile where the image shows a vessel in part, "
                          "or not at all."),
       .bind = [&board](QAction& action) { bind_checked(&action, board.shown); }});
}

}  // namespace

void add_vessel_commands(CommandTable& table, Desk& desk, VesselFinder& finder, OuterWalls& walls,
                         Evaluability& evaluability, QActionGroup& tools) {
  Workbench& bench = desk.bench;
  table.add(unless({.id = "vessel.find",
                    .text = Command::tr("&Find the coronary arteries"),
                    .tip = Command::tr("Finds aorta, ostia and arteries in the image, and names them."),
                    .keys = {"Ctrl+Shift+F"},
                    .run = [&finder] { finder.find_tree(); }},
                   [&bench] { return nothing_to_find(bench); }));
  table.add(unless({.id = "vessel.split",
                    .text = Command::tr("&Split at the cursor"),
                    .tip = vessel_tips::split(),
                    .keys = {"Ctrl+Shift+X"},
                    .run =
                        [&bench] {
                          bench.edit(lumen::BranchSplit{bench.vessel.get(), bench.cursor_mm.get(), {}});
                        }},
                   [&bench] { return no_vessel(bench); }));
  table.add(unless({.id = "vessel.merge",
                    .text = Command::tr("&Join with parent vessel"),
                    .tip = vessel_tips::merge(),
                    .keys = {"Ctrl+Shift+J"},
                    .run = [&bench] { join_with_parent(bench); }},
                   [&bench] { return no_parent(bench); }));
  table.add(unless({.id = "vessel.cut",
                    .text = Command::tr("Cut in &two at the cursor"),
                    .tip = vessel_tips::cut(),
                    .keys = {"Ctrl+Shift+K"},
                    .run =
                        [&bench] {
                          bench.edit(lumen::BranchCut{bench.vessel.get(), bench.cursor_mm.get(), {}});
                        }},
                   [&bench] { return no_vessel(bench); }));
  table.add(unless({.id = "vessel.connect",
                    .text = Command::tr("&Connect to the cursor\u2026"),
                    .tip = vessel_tips::connect(),
                    .keys = {"Ctrl+Shift+C"},
                    .run = [&desk, &bench] { ask_what_to_connect(desk, bench); }},
                   [&bench] { return no_other_vessel(bench); }));
  add_editing_tools(table, desk, tools);
  add_wall_commands(table, walls);
  add_evaluability_commands(table, evaluability);
}

}  // namespace ostia::workstation
