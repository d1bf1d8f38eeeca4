#pragma once
/// \file Which vessel shall begin at the cursor.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

class QMenu;

namespace ostia::workstation {

/// The vessels that can be connected to the cursor's place on the shown vessel, each with its command. Greyed
/// where there is none. It goes when it closes, unless `parent` is a menu that it belongs to.
QMenu* connect_menu(session::Workbench& bench, const Guard& guard, QWidget* parent);

}  // namespace ostia::workstation
