#pragma once
/// \file Help: keys, tour, manual, preferences.

#include "commands/shortcuts.h"
#include "shell/main_window.h"

#include <QObject>
#include <QPointer>

class QMenu;
class QToolBar;

namespace ostia::workstation {

class Keyboard;
class Tour;

/// Adds its commands to the window's menus, gives all commands their keys, tips and pictures, and opens the
/// pages of help. A child of the window. Commands are the window's QActions named as in `shortcuts()`.
class Help final : public QObject {
  Q_OBJECT
 public:
  struct Menus {
    QMenu *edit, *tools, *views;
  };
  Help(MainWindow& window, const Menus& menus);
  const ShortcutKeys& keys() const { return keys_; }
  /// At once, for all commands, and kept in the machine's settings.
  void set_keys(const ShortcutKeys& keys);
  /// Gives every command its keys, tip and picture; again after commands were added.
  void dress_commands();
  std::vector<QAction*> commands() const;
  /// The tour, where it is wanted and the environment has no OSTIA_NO_TOUR.
  void greet();
  /// On the first start on this machine (an empty state folder), or where the person asked for it again.
  static bool wants_tour(const session::MachineState& machine);

 public slots:
  void show_tour();
  void show_shortcuts();
  void show_manual();
  void show_about();
  void show_preferences();

 private:
  QAction* add(QMenu* menu, const QString& id, const QString& text, const std::function<void()>& run);
  void add_views(QMenu* views);
  void add_panels(QMenu* views);
  void add_mouse(QMenu* tools);
  void change_size(double steps);
  void to_lesion(int direction);
  MainWindow& window_;
  Keyboard* keyboard_;
  ShortcutKeys keys_;
  QPointer<Tour> tour_;
};

}  // namespace ostia::workstation
