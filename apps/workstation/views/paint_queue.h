#pragma once
/// \file Who is painted next: one view at a time, so that the mouse is heard between them.

#include <QElapsedTimer>
#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <QWidget>
#include <functional>

namespace ostia::workstation {

/// Views that have something new to show wait here; each turn of the event loop paints one. What takes
/// longest (the tree) goes last.
class PaintQueue final : public QObject {
  Q_OBJECT
 public:
  static PaintQueue& instance();
  /// Once for many requests. As many as there are processors are prepared side by side before the first of
  /// them is painted, no more: the hand waits for all of that. `prepare` is given those of the kind.
  void add(QWidget* view);
  using Prepare = std::function<void(const QList<QWidget*>& views)>;
  void set_prepare(Prepare prepare) { prepare_ = std::move(prepare); }
  /// Work for when all views are painted; once for many requests of one owner.
  void add_last(QObject* owner, std::function<void()> work);
  /// A hand that moves without a pause would keep the others waiting: paints those that have waited too long
  /// already, the views and what is last by turns.
  void serve_overdue();
  /// It has just been painted.
  void remove(QWidget* view);

 private:
  PaintQueue();
  void next();
  bool next_view();  // false where there was none
  bool next_last();
  struct Last {
    QPointer<QObject> owner;
    std::function<void()> work;
  };
  void prepare_next();
  Prepare prepare_;
  int prepared_ = 0;                // of those that are next
  bool views_were_served_ = false;  // when last something was overdue
  QList<QPointer<QWidget>> views_;
  QList<Last> last_;
  bool in_last_ = false;  // what it asks for is more of the same and has waited already
  QTimer timer_;
  QElapsedTimer views_waiting_, last_waiting_;  // since each was last empty
};

}  // namespace ostia::workstation
