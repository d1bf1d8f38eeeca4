#pragma once
/// \file What to begin with, while nothing is open.

#include "shell/card.h"

#include "ostia/session/signal.h"

#include <vector>

class QVBoxLayout;

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// A card over the empty views: open, the sample case, recent cases. It goes as soon as an image or a case
/// is there, or it is said why none could be opened, and comes back when there is nothing of these.
class StartPage final : public Card {
  Q_OBJECT
 public:
  /// Over the views in `over`, which is part of the desk's window.
  StartPage(Desk& desk, const CommandTable& commands, QWidget& over);

 signals:
  void file_chosen(const QString& path);  ///< one of the recent cases

 private:
  void build(const CommandTable& commands);
  void fill_recent();
  void refresh();
  Desk& desk_;
  QVBoxLayout* recent_ = nullptr;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
