#include "views/paint_queue.h"

#include "ostia/core/parallel.h"

#include <QCoreApplication>
#include <QScopedValueRollback>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr qint64 longest_wait_ms = 60;        // of a 2D view
constexpr qint64 longest_last_wait_ms = 110;  // of the tree, which may lag behind

}  // namespace

PaintQueue& PaintQueue::instance() {
  static auto* queue = new PaintQueue;  // goes with the application, whose timers it needs
  return *queue;
}

PaintQueue::PaintQueue() : QObject(QCoreApplication::instance()) {
  timer_.setInterval(0);
  connect(&timer_, &QTimer::timeout, this, &PaintQueue::next);
}

void PaintQueue::add(QWidget* view) {
  if (views_.isEmpty()) views_waiting_.start();
  if (!views_.contains(view)) views_.append(view);
  prepared_ = 0;  // it may be one of them, and they may all show something else by now
  timer_.start();
}

void PaintQueue::add_last(QObject* owner, std::function<void()> work) {
  if (last_.isEmpty() && !in_last_) last_waiting_.start();
  const bool known =
      std::any_of(last_.begin(), last_.end(), [&](const Last& one) { return one.owner == owner; });
  if (!known) last_.append({owner, std::move(work)});
  timer_.start();
}

// One in an event: the hand waits for it.
void PaintQueue::serve_overdue() {
  const bool views = !views_.isEmpty() && views_waiting_.elapsed() > longest_wait_ms;
  const bool last = !last_.isEmpty() && last_waiting_.elapsed() > longest_last_wait_ms;
  const bool views_turn = views && !(last && views_were_served_);
  if (views_turn)
    next_view();
  else if (last)
    next_last();
  if (views || last) views_were_served_ = views_turn;
}

void PaintQueue::remove(QWidget* view) {
  if (views_.removeAll(view) > 0) prepared_ = 0;  // it may have been one of them; twice costs nothing
}

void PaintQueue::prepare_next() {
  if (prepared_ > 0 || !prepare_) return;
  QList<QWidget*> shown;
  for (const QPointer<QWidget>& view : views_) {
    if (shown.size() == core::max_threads()) break;
    ++prepared_;
    if (view && view->isVisible()) shown.append(view);
  }
  if (shown.size() > 1) prepare_(shown);
}

bool PaintQueue::next_view() {
  while (!views_.isEmpty()) {
    prepare_next();
    const QPointer<QWidget> view = views_.takeFirst();
    prepared_ = std::max(0, prepared_ - 1);
    if (!view || !view->isVisible()) continue;
    view->repaint();
    return true;
  }
  return false;
}

bool PaintQueue::next_last() {
  while (!last_.isEmpty()) {
    const Last work = last_.takeFirst();
    if (!work.owner) continue;
    const QScopedValueRollback<bool> inside(in_last_, true);
    work.work();
    return true;
  }
  return false;
}

void PaintQueue::next() {
  if (!next_view() && !next_last()) timer_.stop();
}

}  // namespace ostia::workstation
