#pragma once
/// \file Commands of the window as a whole: steps back and on, theme, preferences, the end.

#include <functional>

namespace ostia::workstation {

class CommandTable;
struct Desk;
class SceneWidget;

/// What Undo and Redo do that is no step of the case; it comes before those.
struct StepsBeside {
  std::function<bool()> can_undo, can_redo;
  std::function<void()> undo, redo;
};

void add_shell_commands(CommandTable& table, Desk& desk, SceneWidget& scene, const StepsBeside& beside);

}  // namespace ostia::workstation
