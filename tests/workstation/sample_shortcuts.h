#pragma once
/// \file Keys of some commands, for tests without a window.

#include "commands/shortcuts.h"

namespace ostia::workstation::testing {

inline Shortcuts sample_shortcuts() {
  return std::make_shared<const std::vector<Shortcut>>(std::vector<Shortcut>{
      {"file.sample", "", ""},
      {"file.report", "Ctrl+R", "Ctrl+R"},
      {"edit.redo", "Ctrl+Shift+Z; Ctrl+Y", "Ctrl+Shift+Z; Ctrl+Y"},
      {"tool.browse", "Esc", "Q; Esc"},
      {"tool.drag", "E", "W"},
      {"tool.draw", "W", "D"},
      {"tool.brush", "B", "B"},
      {"tool.axis", "C", "C"},
      {"tool.angle", "A", "2"},
      {"tool.area", "R", "3"},
      {"help.shortcuts", "F1", "F1"},
  });
}

}  // namespace ostia::workstation::testing
