#pragma once
/// \file What to begin with, while nothing is open.

#include "ostia/session/signal.h"

#include <QFrame>
#include <vector>

class QVBoxLayout;

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// A card over the empty views: open, the sample case, recent cases. It goes as soon as an image or a case
/// is there, and comes back when both are closed.
class StartPage final : public QFrame {
  Q_OBJECT
 public:
  /// Over the views in `over`, which is part of the desk's window.
  StartPage(Desk& desk, const CommandTable& commands, QWidget& over);

 signals:
  void file_chosen(const QString& path);  ///< one of the recent cases

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void build(const CommandTable& commands);
  void fill_recent();
  void refresh();
  void show_or_hide();
  void place();
  Desk& desk_;
  QWidget* over_;
  bool wanted_ = true;
  QVBoxLayout* recent_ = nullptr;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
