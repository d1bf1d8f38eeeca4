// Doing again in the window what a hand did.

#include "qa/dock.h"

#include "ostia/core/error.h"

#include <QApplication>
#include <QKeyEvent>
#include <QProgressBar>
#include <QPushButton>

namespace ostia::workstation {
namespace {

constexpr int tick_ms = 10;
constexpr int at_once_ms = 25;  // of a replay at full speed between two pictures

}  // namespace

void QaDock::start_replay(const std::filesystem::path& path, bool full_speed) {
  if (recorder_ || replay_) return;
  auto replay = std::make_unique<view::HandReplay>(bench_, view::read_hand_recording(path));
  for (PictureWidget* picture : pictures_)
    replay->drive(picture->objectName().toStdString(), picture->view(), picture->pointer());
  replay->begin();
  replay_ = std::move(replay);
  full_speed_ = full_speed;
  progress_->setRange(0, static_cast<int>(replay_->size()));
  progress_->setValue(0);
  qApp->installEventFilter(this);
  show_session();
  replay_clock_.start();
  replay_tick_.start(full_speed ? 0 : tick_ms);
}

void QaDock::replay_some() {
  if (!replay_) return;
  QElapsedTimer spent;
  spent.start();
  bool more = true;
  loud_([&] {
    try {
      while (more && spent.elapsed() < at_once_ms) {
        const std::optional<double> next = replay_->next_ms();
        if (next && !full_speed_ && *next > static_cast<double>(replay_clock_.elapsed())) break;
        more = replay_->step();
      }
    } catch (const Error&) {  // the disk is full: the case is whole, and the replay ends here
      more = false;
      throw;
    }
  });
  if (!replay_) return;  // another case was opened meanwhile
  progress_->setValue(static_cast<int>(replay_->done()));
  if (more) return;
  const std::optional<bool> same = replay_->same();
  const bool whole = replay_->done() == replay_->size();
  end_replay();
  if (!whole) return;
  emit said(!same   ? tr("The replay has ended. The recording does not say what the model was at its end.")
            : *same ? tr("The replay has ended: the model is what it was when it was recorded.")
                    : tr("The replay has ended, but the model is not what it was when it was recorded."));
  emit replayed(same.value_or(false));
}

void QaDock::cancel_replay() {
  if (!replay_) return;
  const std::size_t done = replay_->done(), size = replay_->size();
  end_replay();
  emit said(tr("The replay was ended after %1 of %2 movements.").arg(done).arg(size));
}

void QaDock::end_replay() {
  replay_tick_.stop();
  qApp->removeEventFilter(this);
  const std::unique_ptr<view::HandReplay> ended = std::move(replay_);
  if (ended) ended->cancel();
  for (PictureWidget* picture : pictures_) picture->take_size();
  show_session();
}

bool QaDock::eventFilter(QObject* object, QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::ShortcutOverride:
    case QEvent::Shortcut: {
      // While a replay runs the hand is the recorded one: Escape ends it, and so does the dock's button.
      if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
        cancel_replay();
        return true;
      }
      const auto* widget = qobject_cast<QWidget*>(object);
      if (widget && widget->isWindow()) return QDockWidget::eventFilter(object, event);
      if (widget && (widget == this || isAncestorOf(widget) || widget->window() != window()))
        return QDockWidget::eventFilter(object, event);
      if (widget && event->type() == QEvent::ShortcutOverride) event->accept();  // and so no shortcut
      return widget != nullptr;
    }
    default:
      return QDockWidget::eventFilter(object, event);
  }
}

}  // namespace ostia::workstation
