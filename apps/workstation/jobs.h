#pragma once
/// \file Long work beside the window.

#include "ostia/session/worker_queue.h"

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <any>
#include <functional>
#include <map>

class QLabel;
class QProgressBar;
class QVBoxLayout;

namespace ostia::workstation {

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

 signals:
  void changed();

 private:
  struct Job;
  void poll();
  session::WorkerQueue queue_{2};
  std::map<session::WorkerQueue::JobId, std::shared_ptr<Job>> running_;
  QTimer timer_;
  QVBoxLayout* lines_;
};

}  // namespace ostia::workstation
