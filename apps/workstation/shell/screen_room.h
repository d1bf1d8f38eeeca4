#pragma once
/// \file Windows stay where one can reach them, however many monitors there still are.

#include <QList>
#include <QRect>

class QMainWindow;
class QWidget;

namespace ostia::workstation {

/// `wanted`, where the upper edge of a window there can be taken hold of on one of the screens; else in the
/// nearest of them, no larger than it. Without screens: `wanted`.
QRect on_some_screen(const QRect& wanted, const QList<QRect>& screens);

/// What windows may take of each screen there is, the primary one first.
QList<QRect> screen_rooms();

/// Moves a window that cannot be reached; `window` itself, and its docks that float.
void bring_back(QWidget& window);
void bring_back_docks(QMainWindow& window);

}  // namespace ostia::workstation
