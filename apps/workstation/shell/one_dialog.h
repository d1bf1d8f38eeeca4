#pragma once
/// \file Dialogs of which there is one at a time.

#include <QWidget>
#include <utility>

namespace ostia::workstation {

/// Comes to the front where it is open; else it is made of `args` and goes when it is closed. Its maker gives
/// it `window` as its parent.
template <class Dialog, class... Args>
void show_one(QWidget& window, Args&&... args) {
  auto* dialog = window.findChild<Dialog*>();
  if (!dialog) {
    dialog = new Dialog(std::forward<Args>(args)...);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
  }
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace ostia::workstation
