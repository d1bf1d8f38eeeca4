#pragma once
/// \file Docks and tool bars as they were left: where they stand, how large they are, which are open. Each is
/// known by its object name.

#include <Qt>
#include <map>
#include <string>

class QDockWidget;
class QMainWindow;

namespace ostia::session {
class MachineState;
}

namespace ostia::workstation {

/// Of all that the window has, as settings of this machine.
std::map<std::string, std::string> dock_settings(const QMainWindow& window);
/// What another version kept is left alone. Before the window is shown, with all in it.
void restore_docks(QMainWindow& window, const session::MachineState& machine);

/// For a dock that opens: `size` (its width or height) the first time; after that it has what it was left
/// with.
void size_at_first(QMainWindow& window, QDockWidget& dock, int size, Qt::Orientation orientation);

}  // namespace ostia::workstation
