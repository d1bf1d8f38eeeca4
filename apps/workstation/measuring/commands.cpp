#include "measuring/commands.h"

#include "commands/kinds.h"
#include "commands/table.h"
#include "measuring/reporting.h"
#include "shell/desk.h"
#include "views/picture_widget.h"

namespace ostia::workstation {
namespace {

using session::Tool;

void pin_view(const Desk& desk, Reporting& reporting) {
  if (auto* view = qobject_cast<PictureWidget*>(desk.window.focusWidget()))
    reporting.pin(*view);
  else
    desk.messages.say(Reporting::tr("Click into the CPR, section or slice to be pinned first."));
}

}  // namespace

void add_measuring_commands(CommandTable& table, Desk& desk, Reporting& reporting, QActionGroup& tools) {
  table.add(
      needs_case({.id = "file.report",
                  .text = Command::tr("&Report (PDF, HTML, tables)"),
                  .tip = Command::tr("Makes the report of the case as it is now, in a folder beside it."),
                  .keys = {"Ctrl+R"},
                  .run = [&desk, &reporting] { reporting.ask_and_make(desk.case_path); }},
                 desk));
  table.add(needs_case(
      {.id = "file.report_notes",
       .text = Command::tr("&What the report says\u2026"),
       .tip = Command::tr("Impression, modifiers of CAD-RADS, features of high-risk plaque, signature."),
       .run = [&reporting] { reporting.say_in_report(); }},
      desk));
  table.add(needs_case(
      {.id = "file.pin",
       .text = Command::tr("&Pin this view to the report"),
       .tip = Command::tr("The view that was clicked last becomes a key image of the next report."),
       .keys = {"Ctrl+P"},
       .run = [&desk, &reporting] { pin_view(desk, reporting); }},
      desk));
  table.add(needs_case({.id = "file.export_centerlines",
                        .text = Command::tr("The &centerlines\u2026"),
                        .tip = Command::tr("Writes the centerlines with their radii (VTP)."),
                        .keys = {"Ctrl+Shift+E"},
                        .run = [&reporting] { reporting.export_centerlines(); }},
                       desk));
  table.add(tool_command(
      {
          .text = Command::tr("Distance"),
          .tip = Command::tr("Drag from one place to the other."),
          .keys = {"D", "1"},
      },
      Tool::distance, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Angle"),
          .tip = Command::tr("Click three places, the vertex second."),
          .keys = {"A", "2"},
      },
      Tool::angle, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Area"),
          .tip = Command::tr("Draw around it."),
          .keys = {"R", "3"},
      },
      Tool::area, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Diameter"),
          .tip = Command::tr("Drag across the lumen."),
          .keys = {"F", "4"},
      },
      Tool::diameter, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Stenosis"),
          .tip = Command::tr("On a CPR, drag from the proximal to the distal place of reference."),
          .keys = {"S", "5"},
      },
      Tool::stenosis, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Volume"),
          .tip = Command::tr("On a CPR, drag along the stretch of the vessel."),
          .keys = {"U", "6"},
      },
      Tool::volume, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("HU ring"),
          .tip = Command::tr("Click where CT numbers about the lumen are wanted."),
          .keys = {"H", "7"},
      },
      Tool::ring_hu, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Arrow"),
          .tip = Command::tr("Drag from what it points at to where its text is to stand."),
          .keys = {"G", "8"},
      },
      Tool::arrow, desk, tools));
  table.add(tool_command(
      {
          .text = Command::tr("Note"),
          .tip = Command::tr("Click a place, and type what is to stand beside it."),
          .keys = {"N", "9"},
      },
      Tool::note, desk, tools));
}

}  // namespace ostia::workstation
