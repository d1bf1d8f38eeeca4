#include "shell/tool_bar_fit.h"

#include <QEvent>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int icon_size = 22;
constexpr int slack = 24;  // for what a style puts between bars

}  // namespace

ToolBarFit::ToolBarFit(QWidget* window, QToolBar* tools, QToolBar* others)
    : QObject(window), window_(window), tools_(tools), others_(others) {
  tools->setIconSize(QSize(icon_size, icon_size));
  window->installEventFilter(this);
  fit();
}

int ToolBarFit::width_with_words() const {
  int width = 0;
  for (QToolButton* button : tools_->findChildren<QToolButton*>()) {
    if (!tools_->actions().contains(button->defaultAction())) continue;
    const Qt::ToolButtonStyle now = button->toolButtonStyle();
    button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
    width += button->sizeHint().width();
    button->setToolButtonStyle(now);
  }
  for (const QAction* action : tools_->actions())
    if (action->isSeparator()) width += 8;
  return width;
}

void ToolBarFit::fit() {
  const bool room = width_with_words() + others_->sizeHint().width() + slack <= window_->width();
  const Qt::ToolButtonStyle wanted = room ? Qt::ToolButtonTextUnderIcon : Qt::ToolButtonIconOnly;
  if (tools_->toolButtonStyle() != wanted) tools_->setToolButtonStyle(wanted);
}

bool ToolBarFit::eventFilter(QObject* object, QEvent* event) {
  if (object == window_ && (event->type() == QEvent::Resize || event->type() == QEvent::Show)) fit();
  return QObject::eventFilter(object, event);
}

}  // namespace ostia::workstation
