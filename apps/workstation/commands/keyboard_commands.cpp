#include "commands/keyboard_commands.h"

#include "commands/keyboard.h"
#include "commands/table.h"

namespace ostia::workstation {

void add_keyboard_commands(CommandTable& table, Keyboard& keyboard) {
  const auto go_to = [&keyboard](const char* station) {
    return [&keyboard, station] { keyboard.go_to(station); };
  };
  table.add({.id = "panel.next",
             .text = Command::tr("Next panel"),
             .tip = Command::tr("The keyboard goes to the next panel."),
             .keys = {"Ctrl+Tab"},
             .run = [&keyboard] { keyboard.go_by(1); }});
  table.add({.id = "panel.previous",
             .text = Command::tr("Previous panel"),
             .tip = Command::tr("The keyboard goes to the previous panel."),
             .keys = {"Ctrl+Shift+Tab"},
             .run = [&keyboard] { keyboard.go_by(-1); }});
  table.add({.id = "panel.alone",
             .text = Command::tr("This panel alone"),
             .tip = Command::tr("The panel with the keyboard fills the window; again: all panels."),
             .keys = {"F11"},
             .run = [&keyboard] { keyboard.maximise_focused(); }});
  table.add(
      {.id = "panel.vessels", .text = Command::tr("Vessels"), .keys = {"Alt+1"}, .run = go_to("vessels")});
  table.add({.id = "panel.cpr1", .text = Command::tr("CPR"), .keys = {"Alt+2"}, .run = go_to("cpr1")});
  table.add(
      {.id = "panel.cpr2", .text = Command::tr("CPR + 90\u00b0"), .keys = {"Alt+3"}, .run = go_to("cpr2")});
  table.add({.id = "panel.section",
             .text = Command::tr("Cross-section"),
             .keys = {"Alt+4"},
             .run = go_to("section")});
  table.add({.id = "panel.slice", .text = Command::tr("Slice"), .keys = {"Alt+5"}, .run = go_to("slice")});
  table.add(
      {.id = "panel.tree", .text = Command::tr("Coronary tree"), .keys = {"Alt+6"}, .run = go_to("tree")});
  table.add({.id = "panel.profile",
             .text = Command::tr("Lumen profile"),
             .keys = {"Alt+7"},
             .run = go_to("profile")});
  table.add({.id = "panel.measurements",
             .text = Command::tr("Measurements"),
             .keys = {"Alt+8"},
             .run = go_to("measurements")});
  table.add({.id = "panel.steps", .text = Command::tr("Steps"), .keys = {"Alt+9"}, .run = go_to("steps")});
  table.add(
      {.id = "panel.lesions", .text = Command::tr("Lesions"), .keys = {"Alt+0"}, .run = go_to("lesions")});
  table.add({.id = "mouse.left",
             .text = Command::tr("Pointer to the left"),
             .tip = Command::tr("Moves the mouse pointer by one pixel; held down, faster."),
             .keys = {"Alt+Shift+Left"},
             .run = [&keyboard] { keyboard.move_mouse(-1, 0); }});
  table.add({.id = "mouse.right",
             .text = Command::tr("Pointer to the right"),
             .tip = Command::tr("Moves the mouse pointer by one pixel; held down, faster."),
             .keys = {"Alt+Shift+Right"},
             .run = [&keyboard] { keyboard.move_mouse(1, 0); }});
  table.add({.id = "mouse.up",
             .text = Command::tr("Pointer up"),
             .tip = Command::tr("Moves the mouse pointer by one pixel; held down, faster."),
             .keys = {"Alt+Shift+Up"},
             .run = [&keyboard] { keyboard.move_mouse(0, -1); }});
  table.add({.id = "mouse.down",
             .text = Command::tr("Pointer down"),
             .tip = Command::tr("Moves the mouse pointer by one pixel; held down, faster."),
             .keys = {"Alt+Shift+Down"},
             .run = [&keyboard] { keyboard.move_mouse(0, 1); }});
  table.add({.id = "mouse.press",
             .text = Command::tr("Press or let go"),
             .tip = Command::tr("Presses the main mouse button and holds it; again: lets it go."),
             .keys = {"Ins"},
             .run = [&keyboard] { keyboard.press_or_release(); }});
}

}  // namespace ostia::workstation
