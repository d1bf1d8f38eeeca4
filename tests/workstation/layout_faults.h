#pragma once
/// \file Whether everything in a window can be seen and read.

#include <QStringList>
#include <QWidget>

namespace ostia::workstation::testing {

/// What is wrong with the visible widgets of one window, a sentence each: texts that are wider or higher
/// than their widget (a list's entry or a header's title may be, where its tool tip has the whole text),
/// widgets that lie over their neighbours, or outside of the window and of no area that scrolls.
QStringList layout_faults(const QWidget& window);

}  // namespace ostia::workstation::testing
