#pragma once
/// \file The cases that were open last, in a menu.

#include <QString>
#include <functional>

class QMenu;

namespace ostia::workstation {

struct Desk;

/// Fills the menu whenever it is about to be shown.
void list_recent_cases(QMenu& menu, const Desk& desk, std::function<void(const QString& path)> open);

}  // namespace ostia::workstation
