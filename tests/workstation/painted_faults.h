#pragma once
/// \file Whether what views paint over their pictures can be read.

#include <QStringList>
#include <QWidget>

namespace ostia::workstation::testing {

/// What is wrong with the texts that the visible views of a window painted last, a sentence each: one over
/// another, one that is cut off at the rim or shortened, one that found no room.
QStringList painted_faults(const QWidget& window);
/// How many texts those views have painted.
int painted_count(const QWidget& window);

}  // namespace ostia::workstation::testing
