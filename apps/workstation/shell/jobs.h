#pragma once
/// \file Long work beside the window.

#include "ostia/session/worker_queue.h"

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <any>
#include <functional>
#include <map>
#include <optional>

class QLabel;
class QProgressBar;
class QVBoxLayout;

namespace ostia::workstation {

/// Seconds that are left at the pace so far; nothing before 2 s have passed and 5 % are done, since it would
/// be a guess.
std::optional<double> seconds_left(double progress, qint64 elapsed_ms);

/// Runs work in the background and shows a line with progress, time left and a cross for each. Results and
/// failures arrive in the interface's thread.
class Jobs final : public QWidget {
  Q_OBJECT
 public:
  using Work = std::function<std::any(const core::TaskContext&)>;
  using Done = std::function<void(std::any)>;
  using Failed = std::function<void(const QString& message)>;
  explicit Jobs(QWidget* parent = nullptr);
  /// A newer job of a kind takes the place of an older one. A cancelled job ends without a word.
  void run(const QString& kind, const QString& title, Work work, Done done, Failed failed);
  void cancel(const QString& kind);
  bool any() const { return !running_.empty(); }
  bool running(const QString& kind) const;
  /// A line that stays until it is closed: what a job has made, and a button that does something with it.
  /// The next of its kind, or a new job of it, takes its place.
  void leave(const QString& kind, const QString& text, const QString& tip, const QString& button,
             std::function<void()> act);
  /// Of one line, so that room can be kept and nothing moves when a job begins.
  int line_height() const;

 signals:
  void changed();

 private:
  struct Job;
  void poll();
  void take_away(const QString& kind);
  session::WorkerQueue queue_{4};  // a surface, a mesh, a solver's run of hours, and what editing needs
  std::map<session::WorkerQueue::JobId, std::shared_ptr<Job>> running_;
  std::map<QString, QWidget*> left_;  // lines that stay, by kind
  QTimer timer_;
  QVBoxLayout* lines_;
};

}  // namespace ostia::workstation
