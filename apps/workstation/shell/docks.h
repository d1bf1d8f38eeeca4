#pragma once
/// \file Docks and tool bars as they were left: where they stand, how large they are, which are open. Each is
/// known by its object name.

#include <Qt>
#include <map>
#include <optional>
#include <string>

class QDockWidget;
class QMainWindow;

namespace ostia::workstation {

/// Of all that the window has, as settings of this machine.
std::map<std::string, std::string> dock_settings(const QMainWindow& window);
/// What another version kept is left alone. Before the window is shown, with all in it.
/// `docks`, `opened`: those two settings; nothing where there are none.
void restore_docks(QMainWindow& window, const std::optional<std::string>& docks,
                   const std::optional<std::string>& opened);

/// For a dock that opens: `size` (its width or height) the first time; after that it has what it was left
/// with.
void size_at_first(QMainWindow& window, QDockWidget& dock, int size, Qt::Orientation orientation);

}  // namespace ostia::workstation
