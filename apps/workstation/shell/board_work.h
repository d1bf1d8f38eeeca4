#pragma once
/// \file What a board of the session wants to know of each vessel, found in the background.

#include "ostia/core/parallel.h"
#include "ostia/core/task_context.h"
#include "ostia/session/workbench.h"

#include <QThreadPool>
#include <QTimer>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::workstation {

/// Does a board's work (Board::work, Board::take), one vessel after the other, in a thread of its own,
/// whenever case, image or model have been let alone for `pause_ms`; where the model is another when the work
/// is done, it is done again. Work is a type with `Found` and `found(task)`, for any thread; what throws has
/// found nothing. Belongs to the window's thread and goes before the board.
template <class Board, class Work>
class BoardWork {
 public:
  BoardWork(session::Workbench& bench, Board& board, int pause_ms) : board_(board) {
    thread_.setMaxThreadCount(1);
    soon_.setSingleShot(true);
    soon_.setInterval(pause_ms);
    QObject::connect(&soon_, &QTimer::timeout, &soon_, [this] { look(); });
    const auto later = [this](const auto&...) { soon_.start(); };
    own_.push_back(bench.model_changed.observe(later));
    own_.push_back(bench.image_changed.observe(later));
    own_.push_back(bench.case_changed.observe(later));
  }
  ~BoardWork() {
    task_.cancel();
    thread_.waitForDone();
  }
  BoardWork(const BoardWork&) = delete;
  BoardWork& operator=(const BoardWork&) = delete;
  /// Nothing is being looked for, nor will be before the next edit.
  bool idle() const { return !looking_ && !soon_.isActive() && !board_.work(); }

 private:
  void look() {
    if (looking_) return;
    std::optional<Work> work = board_.work();
    if (!work) return;
    looking_ = true;
    thread_.start([this, work = std::move(*work), task = task_] {
      core::lower_thread_priority();
      std::optional<typename Work::Found> found;
      try {
        found = work.found(task);
      } catch (const std::exception&) {  // who looks at the vessel is told why it cannot be measured
      }
      QMetaObject::invokeMethod(
          &soon_, [this, work, found = std::move(found)]() mutable { take(work, std::move(found)); },
          Qt::QueuedConnection);
    });
  }
  void take(const Work& work, std::optional<typename Work::Found> found) {
    looking_ = false;
    if (board_.take(work, std::move(found)))
      look();
    else
      soon_.start();
  }

  Board& board_;
  QTimer soon_;
  QThreadPool thread_;
  core::TaskContext task_;
  bool looking_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
