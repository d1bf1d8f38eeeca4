#pragma once
/// \file What the window says to the person: in a line, or in a dialog.

#include "ostia/session/signal.h"

#include <QCoreApplication>
#include <QString>
#include <QTime>
#include <deque>
#include <functional>

class QWidget;

namespace ostia::workstation {

/// What was said, and when.
struct Said {
  QTime time;
  QString text;
};

class Messages {
  Q_DECLARE_TR_FUNCTIONS(ostia::workstation::Messages)
 public:
  using Line = std::function<void(const QString&)>;
  /// Dialogs belong to `over`. `status` shows a line for a while; `shown_name` shows whose image it is.
  explicit Messages(QWidget& over, Line status = {}, Line shown_name = {});
  void say(const QString& text) const;                                  ///< in the status line
  void complain(const QString& text, const QString& title = {}) const;  ///< one dialog
  /// Runs it; what is refused comes up in the status line (or, `loud`, as a dialog) and ends there: false.
  bool guarded(const std::function<void()>& act, bool loud = false) const;
  void keep(const QString& text) const;  ///< among what was said, though it is shown by other means
  /// What was said since the window is there, the last `most_kept`, the newest last. Written nowhere.
  const std::deque<Said>& log() const { return log_; }
  static constexpr std::size_t most_kept = 500;
  mutable session::Signal<> logged;
  /// Patient and series, in the window alone.
  void set_shown_name(const QString& text) const;

 private:
  QWidget& over_;
  Line status_, shown_name_;
  mutable std::deque<Said> log_;
};

}  // namespace ostia::workstation
