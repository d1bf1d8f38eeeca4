#pragma once
/// \file A hand that moves over windows, for tests.

#include <unistd.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QMessageBox>
#include <QMouseEvent>
#include <QScreen>
#include <QThread>
#include <QTimer>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace ostia::workstation::testing {

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "ostia-window-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Lets the window work until `done`; false after `most_ms`.
template <class Done>
bool wait_until(const Done& done, int most_ms = 20000) {
  QElapsedTimer clock;
  clock.start();
  while (!done()) {
    if (clock.elapsed() > most_ms) return false;
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    QThread::msleep(1);  // the processor is for what is waited for, and for the tests beside this one
  }
  return true;
}

/// Notes when anything was last painted, or given a place.
class LastDrawn final : public QObject {
 public:
  LastDrawn() {
    clock_.start();
    qApp->installEventFilter(this);
  }
  qint64 quiet_ms() const { return clock_.elapsed(); }
  /// As `quiet_ms`, but time in which the window had no processor counts little. To be asked often.
  qint64 rested_ms() {
    constexpr qint64 most_of_a_turn_ms = 10;
    const qint64 now = clock_.elapsed();
    rested_ += std::min(now - asked_, most_of_a_turn_ms);
    asked_ = now;
    return rested_;
  }
  bool eventFilter(QObject*, QEvent* event) override {
    switch (event->type()) {
      case QEvent::Paint:
      case QEvent::UpdateRequest:
      case QEvent::LayoutRequest:
      case QEvent::Resize:
      case QEvent::Move:
      case QEvent::Expose:
        clock_.restart();
        asked_ = rested_ = 0;
        break;
      default:
        break;
    }
    return false;
  }

 private:
  QElapsedTimer clock_;
  qint64 asked_ = 0, rested_ = 0;
};

/// Lets the window work for `ms`: what it puts off for a moment is done then. Where the machine has much else
/// to do, longer, until nothing has been drawn for a while.
inline void let_work(int ms) {
  constexpr int quiet_ms = 50, most_more_ms = 3000;
  const LastDrawn drawn;
  QElapsedTimer clock;
  clock.start();
  wait_until([&] { return clock.elapsed() >= ms && drawn.quiet_ms() >= quiet_ms; }, ms + most_more_ms);
}

/// Lets the window work until it has come to rest: nothing is drawn any more, for longer than it puts off
/// lists and pictures (150 ms the finer picture of the tree). Flights of the camera end before.
inline void let_rest() {
  constexpr int rest_ms = 190, most_ms = 3000;
  LastDrawn drawn;
  wait_until([&] { return drawn.rested_ms() >= rest_ms; }, most_ms);
}

/// What the screen shows of a window at rest; kept as a PNG of this name where OSTIA_PICTURES says.
inline QImage on_screen(const QWidget& window, const QString& name) {
  let_rest();
  const QRect all = window.frameGeometry();
  QImage picture = window.screen()->grabWindow(0, all.x(), all.y(), all.width(), all.height()).toImage();
  if (const char* pictures = std::getenv("OSTIA_PICTURES"))
    picture.save(QString("%1/%2.png").arg(pictures, name));
  return picture;
}

inline void send(QWidget& widget, QEvent::Type type, const QPoint& at, Qt::MouseButton button,
                 Qt::MouseButtons held, Qt::KeyboardModifiers keys = Qt::NoModifier) {
  QMouseEvent event(type, at, widget.mapToGlobal(at), button, held, keys);
  QApplication::sendEvent(&widget, &event);
}

/// Presses at the first place, moves through all of them, and lets go at the last.
inline void sweep(QWidget& widget, const std::vector<QPoint>& way,
                  Qt::KeyboardModifiers keys = Qt::NoModifier) {
  send(widget, QEvent::MouseMove, way.front(), Qt::NoButton, Qt::NoButton, keys);
  send(widget, QEvent::MouseButtonPress, way.front(), Qt::LeftButton, Qt::LeftButton, keys);
  for (const QPoint& at : way) send(widget, QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, keys);
  send(widget, QEvent::MouseButtonRelease, way.back(), Qt::LeftButton, Qt::NoButton, keys);
  QApplication::processEvents();
}

/// The next file dialog is given this name and accepted.
inline void answer_file_dialog(const std::filesystem::path& path) {
  QTimer::singleShot(300, [path] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    dialog->findChild<QLineEdit*>()->setText(QString::fromStdString(path.string()));
    QMetaObject::invokeMethod(dialog, "accept");
  });
}

/// The messages on the screen.
inline std::vector<QMessageBox*> open_boxes() {
  std::vector<QMessageBox*> boxes;
  for (QWidget* widget : QApplication::topLevelWidgets())
    if (auto* box = qobject_cast<QMessageBox*>(widget); box && box->isVisible()) boxes.push_back(box);
  return boxes;
}

/// The text of the one message that comes up; it is then closed.
inline std::string message() {
  if (!wait_until([] { return !open_boxes().empty(); })) return "no message";
  const auto boxes = open_boxes();
  const std::string text = boxes.size() == 1 ? boxes.front()->text().toStdString() : "several messages";
  for (QMessageBox* box : boxes) box->close();
  QApplication::processEvents();
  return text;
}

}  // namespace ostia::workstation::testing
