#pragma once
/// \file What to begin with, while nothing is open.

#include "shell/main_window.h"

#include <QFrame>

class QVBoxLayout;

namespace ostia::workstation {

/// A card over the empty views: open, the sample case, recent cases. It goes as soon as an image or a case
/// is there, and comes back when both are closed.
class StartPage final : public QFrame {
  Q_OBJECT
 public:
  /// Of a window whose commands and views are there; it lies over the views of this name.
  StartPage(MainWindow& window, const QString& over);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void build();
  void fill_recent();
  void refresh();
  void show_or_hide();
  void place();
  MainWindow& window_;
  QWidget* over_;
  bool wanted_ = true;
  QVBoxLayout* recent_ = nullptr;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
