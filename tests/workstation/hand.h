#pragma once
/// \file A hand that moves over windows, for tests.

#include <unistd.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QMouseEvent>
#include <QTimer>
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
  }
  return true;
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
