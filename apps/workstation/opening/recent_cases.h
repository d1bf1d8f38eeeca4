#pragma once
/// \file The cases that were open last, in a menu.

#include "ostia/session/machine_state.h"

#include <QString>
#include <functional>

class QMenu;

namespace ostia::workstation {

struct Desk;

/// `name` of the case, after whose it is where this machine knows it.
QString recent_case_text(const Desk& desk, const session::RecentCase& one, const QString& name);

/// Fills the menu whenever it is about to be shown.
void list_recent_cases(QMenu& menu, const Desk& desk, std::function<void(const QString& path)> open);

}  // namespace ostia::workstation
