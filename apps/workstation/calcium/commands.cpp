#include "calcium/commands.h"

#include "calcium/page.h"
#include "calcium/reading.h"
#include "commands/table.h"
#include "shell/bind.h"
#include "shell/desk.h"

namespace ostia::workstation {
namespace {

using analysis::CalciumPlace;

void add_place(CommandTable& table, Calcium& calcium, const char* id, const QString& text, const char* keys,
               CalciumPlace place) {
  table.add(
      {.id = id,
       .text = text,
       .tip = Command::tr("Says where the chosen lesion of calcium lies; Undo takes it back."),
       .keys = {keys},
       .run = [&calcium, place] { calcium.say(place); },
       .enabled = [&calcium] { return calcium.board().lesion(calcium.board().chosen.get()) != nullptr; },
       .why_not = [] { return Command::tr("No lesion of calcium is chosen."); }});
}

}  // namespace

void add_calcium_commands(CommandTable& table, Desk& desk, Calcium& calcium, CalciumPage& page) {
  table.add({.id = "calcium.score",
             .text = Command::tr("Calcium &score"),
             .tip = Command::tr("Finds the calcium of a CT without contrast agent and counts it by artery."),
             .keys = {"Ctrl+Shift+A"},
             .run =
                 [&calcium, &page] {
                   page.show();
                   page.raise();
                   calcium.score();
                 },
             .enabled = [&desk] { return desk.bench.shown_volume() != nullptr; },
             .why_not = [] { return Command::tr("No image is open."); }});
  add_place(table, calcium, "calcium.lm", Command::tr("L&M"), "Ctrl+5", CalciumPlace::left_main);
  add_place(table, calcium, "calcium.lad", Command::tr("&LAD"), "Ctrl+6", CalciumPlace::lad);
  add_place(table, calcium, "calcium.lcx", Command::tr("LC&X"), "Ctrl+7", CalciumPlace::lcx);
  add_place(table, calcium, "calcium.rca", Command::tr("&RCA"), "Ctrl+8", CalciumPlace::rca);
  add_place(table, calcium, "calcium.none", Command::tr("&Not coronary"), "Ctrl+9", CalciumPlace::other);
  table.add({.id = "calcium.report",
             .text = Command::tr("&Take it into the report"),
             .tip = Command::tr("The report of the case that is open says this score."),
             .run = [&calcium] { calcium.into_report(); },
             .enabled = [&calcium] { return calcium.why_not_into_report().isEmpty(); },
             .why_not = [&calcium] { return calcium.why_not_into_report(); }});
  table.add(
      {.id = "calcium.save",
       .text = Command::tr("&Write tables and pictures\u2026"),
       .tip = Command::tr("A folder with the score as JSON, the lesions as a table and a mask, and slices."),
       .run = [&calcium] { calcium.save(); },
       .enabled = [&calcium] { return calcium.board().reading() != nullptr; },
       .why_not = [] { return Command::tr("No scan has been scored."); }});
  keep_with(&table, calcium.board().changed.observe([&table] { table.refresh(); }));
  keep_with(&table, calcium.board().chosen.observe([&table](const int&) { table.refresh(); }));
}

}  // namespace ostia::workstation
