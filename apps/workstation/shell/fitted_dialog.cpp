#include "shell/fitted_dialog.h"

#include <QLayout>
#include <QResizeEvent>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int usual_width = 560, margin = 40;

}  // namespace

FittedDialog::FittedDialog(QWidget* parent) : QDialog(parent) {
  setMinimumWidth(parent ? std::min(usual_width, parent->width() - margin) : usual_width);
  resize(minimumWidth(), 0);
}

void FittedDialog::fit() {
  if (!layout()) return;
  // Texts that wrap say what height they need for a width; a window does not ask by itself.
  layout()->activate();
  const int needed = layout()->hasHeightForWidth() ? layout()->totalHeightForWidth(width())
                                                   : layout()->totalMinimumSize().height();
  setMinimumHeight(needed);
  if (height() < needed) resize(width(), needed);
}

void FittedDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  if (event->size().width() != event->oldSize().width()) fit();
}

void FittedDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  fit();
}

}  // namespace ostia::workstation
