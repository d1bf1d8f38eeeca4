#pragma once
/// \file Commands of the window as a whole: steps back and on, theme, preferences, the end.

namespace ostia::workstation {

class CommandTable;
struct Desk;
class SceneWidget;

void add_shell_commands(CommandTable& table, Desk& desk, SceneWidget& scene);

}  // namespace ostia::workstation
