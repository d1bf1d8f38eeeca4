#include "paint_queue.h"

#include <QCoreApplication>
#include <algorithm>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr qint64 longest_wait_ms = 70;

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
  if (!views_.contains(view)) views_.append(view);
  begin();
}

void PaintQueue::add_last(QObject* owner, std::function<void()> work) {
  const bool known =
      std::any_of(last_.begin(), last_.end(), [&](const Last& one) { return one.owner == owner; });
  if (!known) last_.append({owner, std::move(work)});
  begin();
}

void PaintQueue::begin() {
  if (timer_.isActive()) return;
  waiting_.start();
  timer_.start();
}

void PaintQueue::serve_overdue() {
  if (!timer_.isActive() || waiting_.elapsed() < longest_wait_ms) return;
  while (timer_.isActive()) next();
}

void PaintQueue::next() {
  while (!views_.isEmpty()) {
    const QPointer<QWidget> view = views_.takeFirst();
    if (!view || !view->isVisible()) continue;
    view->repaint();
    return;
  }
  while (!last_.isEmpty()) {
    const Last work = last_.takeFirst();
    if (!work.owner) continue;
    work.work();
    return;
  }
  timer_.stop();
}

}  // namespace ostia::workstation
