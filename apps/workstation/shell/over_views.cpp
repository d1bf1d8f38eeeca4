#include "shell/over_views.h"

#include <QEvent>
#include <QMainWindow>
#include <QMenuBar>
#include <QStatusBar>
#include <QToolBar>
#include <algorithm>

namespace ostia::workstation {

OverViews::OverViews(QMainWindow& window) : QFrame(&window), window_(window) {
  setAutoFillBackground(true);
  window_.installEventFilter(this);
  hide();
}

OverViews::~OverViews() {
  window_.removeEventFilter(this);
  if (!isHidden()) bring_views_back();
}

void OverViews::place() {
  int top = window_.menuBar()->geometry().bottom() + 1;
  for (const QToolBar* bar : window_.findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly))
    if (bar->isVisible() && bar->geometry().height() < window_.height() / 2)
      top = std::max(top, bar->geometry().bottom() + 1);
  const int bottom = window_.statusBar()->geometry().top();
  setGeometry(0, top, window_.width(), std::max(1, bottom - top));
}

bool OverViews::eventFilter(QObject* object, QEvent* event) {
  if (object == &window_ && !isHidden() &&
      (event->type() == QEvent::Resize || event->type() == QEvent::LayoutRequest))
    place();
  return QFrame::eventFilter(object, event);
}

void OverViews::showEvent(QShowEvent* event) {
  // The views lie in a window of the system's own, which nothing can cover: they are hidden.
  if (window_.centralWidget()) window_.centralWidget()->hide();
  place();
  raise();
  QFrame::showEvent(event);
}

void OverViews::hideEvent(QHideEvent* event) {
  if (isHidden()) bring_views_back();  // else the whole window goes
  QFrame::hideEvent(event);
}

void OverViews::bring_views_back() {
  for (const OverViews* other : window_.findChildren<OverViews*>())
    if (other != this && !other->isHidden()) return;
  if (QWidget* views = window_.centralWidget()) views->show();
}

}  // namespace ostia::workstation
