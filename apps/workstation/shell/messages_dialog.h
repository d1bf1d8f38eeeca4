#pragma once
/// \file What the window has said, to be looked up again.

#include "ostia/session/signal.h"

#include <QDialog>

class QPlainTextEdit;

namespace ostia::workstation {

struct Desk;

/// A line each, with the time of day, the newest last; follows what is said while it is open.
class MessagesDialog final : public QDialog {
  Q_OBJECT
 public:
  explicit MessagesDialog(Desk& desk);

 private:
  void fill();
  Desk& desk_;
  QPlainTextEdit* text_;
  session::Subscription more_;
};

}  // namespace ostia::workstation
