#include "shell/screen_room.h"

#include <QDockWidget>
#include <QGuiApplication>
#include <QMainWindow>
#include <QScreen>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int grip_high = 24, grip_wide = 100;  // of the upper edge, for a hand

bool reachable(const QRect& window, const QRect& screen) {
  const QRect edge(window.left(), window.top(), window.width(), grip_high);
  const QRect seen = edge.intersected(screen);
  return seen.width() >= std::min(grip_wide, window.width()) && 2 * seen.height() >= grip_high;
}

/// Between the two, 0 where they meet.
qint64 distance_between(const QRect& a, const QRect& b) {
  const qint64 dx = std::max({0, a.left() - b.right(), b.left() - a.right()});
  const qint64 dy = std::max({0, a.top() - b.bottom(), b.top() - a.bottom()});
  return dx * dx + dy * dy;
}

}  // namespace

QRect on_some_screen(const QRect& wanted, const QList<QRect>& screens) {
  if (screens.isEmpty() || std::any_of(screens.begin(), screens.end(),
                                       [&](const QRect& screen) { return reachable(wanted, screen); }))
    return wanted;
  const QRect screen = *std::min_element(screens.begin(), screens.end(), [&](const QRect& a, const QRect& b) {
    return distance_between(wanted, a) < distance_between(wanted, b);
  });
  QRect moved(wanted.topLeft(), wanted.size().boundedTo(screen.size()));
  moved.moveLeft(std::clamp(moved.left(), screen.left(), screen.right() - moved.width() + 1));
  moved.moveTop(std::clamp(moved.top(), screen.top(), screen.bottom() - moved.height() + 1));
  return moved;
}

QList<QRect> screen_rooms() {
  QList<QRect> rooms;
  for (const QScreen* screen : QGuiApplication::screens()) rooms << screen->availableGeometry();
  return rooms;
}

void bring_back(QWidget& window) {
  const QRect now = window.geometry(), reached = on_some_screen(now, screen_rooms());
  if (reached != now) window.setGeometry(reached);
}

void bring_back_docks(QMainWindow& window) {
  for (QDockWidget* dock : window.findChildren<QDockWidget*>())
    if (dock->isFloating()) bring_back(*dock);
}

}  // namespace ostia::workstation
