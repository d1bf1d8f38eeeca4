#pragma once
/// \file Why the views are empty, and the ways out.

#include "shell/card.h"

#include "ostia/session/signal.h"

#include <QStringList>
#include <vector>

class QLabel;
class QVBoxLayout;

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// In place of views that have nothing to show: what failed (Desk::failure) or, over an image without a
/// vessel, that there is none yet, with a button for each command that helps and can be used. What the tool
/// waits for stands there, too, as long as it waits.
class FailurePanel final : public Card {
  Q_OBJECT
 public:
  /// Over the views in `over`, which is part of the desk's window.
  FailurePanel(Desk& desk, const CommandTable& commands, QWidget& over);

 private:
  void refresh();
  void fill_ways(const QStringList& ways);
  QString waiting_for() const;
  bool vessels_are_coming() const;
  Desk& desk_;
  const CommandTable& commands_;
  QLabel *title_, *reason_, *waiting_;
  QVBoxLayout* ways_;
  /// A button of those that are shown.
  struct Way {
    QString id, text, tip;
    bool operator==(const Way&) const = default;
  };
  std::vector<Way> shown_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
