#pragma once
/// \file The menus: which command stands where.

#include <QStringList>

class QMenu;
class QMenuBar;

namespace ostia::workstation {

class CommandTable;

struct BuiltMenus {
  QStringList order;         ///< of all commands, as the menus list them
  QMenu* recent = nullptr;   ///< for the recent cases
  QMenu* layouts = nullptr;  ///< takes a person's own layouts, too
  QMenu* greys = nullptr;    ///< takes a person's own grey levels
  QMenu* plugins = nullptr;  ///< takes the plug-ins
};
/// Throws std::logic_error where a command of the table stands in no menu, or one of a menu not in the table.
BuiltMenus build_menus(QMenuBar& bar, const CommandTable& commands);

}  // namespace ostia::workstation
