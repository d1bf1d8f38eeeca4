#pragma once
/// \file A program that is asked to end (a logout, `kill`, Ctrl+C) ends as if its window were closed.

#include <QObject>
#include <QSocketNotifier>
#include <array>

namespace ostia::workstation {

/// From its making on SIGTERM, SIGINT and SIGHUP are told by asked() in the thread of the event loop, and end
/// nothing by themselves. One at a time; a second one of the same process throws IoError.
class EndingSignals final : public QObject {
  Q_OBJECT
 public:
  explicit EndingSignals(QObject* parent = nullptr);
  ~EndingSignals() override;

 signals:
  void asked();

 private:
  std::array<int, 2> pipe_{-1, -1};  // a signal handler may do little more than write
  QSocketNotifier* notifier_ = nullptr;
};

}  // namespace ostia::workstation
