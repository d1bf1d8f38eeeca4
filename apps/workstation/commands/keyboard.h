#pragma once
/// \file Keys where widgets and shortcuts do not settle it between themselves, and a mouse moved by keys.

#include <QObject>
#include <QStringList>

class QWidget;
class QPoint;

namespace ostia::workstation {

/// - What is typed into a line, a list or a button stays there, though it be a command's shortcut.
/// - Escape ends a gesture before it changes the tool.
/// - The tree and the profile, which know the mouse alone, answer to arrow keys.
/// - Focus goes from panel to panel.
/// - The mouse's pointer and main button by keys, so that every gesture can be made without a mouse.
class Keyboard final : public QObject {
  Q_OBJECT
 public:
  /// Watches all events of the application; a child of the window.
  explicit Keyboard(QWidget* window);
  /// The names of the widgets that take the focus, in the order of the panels.
  static const QStringList& stations();
  void go_to(const QString& station);  ///< nothing happens where it is hidden
  void go_by(int steps);
  void maximise_focused();
  void move_mouse(int right, int down);  ///< in units of the interface, faster when repeated quickly
  void press_or_release();

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  QWidget* station(const QString& name) const;
  int current_station() const;
  bool kept_from_shortcuts(QObject* object, int key, Qt::KeyboardModifiers keys) const;
  bool key_for_tree(int key);
  bool key_for_profile(int key);
  bool send_mouse(int type, const QPoint& at);
  QWidget* window_;
  qint64 last_move_ms_ = 0;
  int speed_ = 1;
  bool held_ = false;
};

}  // namespace ostia::workstation
