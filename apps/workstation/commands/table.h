#pragma once
/// \file All commands of the window, each in one row.

#include "commands/command.h"
#include "commands/shortcuts.h"

#include "ostia/session/signal.h"

#include <QObject>
#include <QStringList>
#include <vector>

class QToolButton;

namespace ostia::workstation {

struct Desk;

/// Each part of the window adds its commands; menus, tool bars and pages then take them from here. A child of
/// the desk's window, as are the actions.
class CommandTable final : public QObject {
  Q_OBJECT
 public:
  explicit CommandTable(Desk& desk);
  /// Throws std::logic_error for an id that is there already.
  void add(Command command);
  /// With its action; nothing where there is none. A list of commands that is open is not to be used again.
  void take_away(const QString& id);
  /// Gives all commands their keys (those of this machine's settings), tips and pictures. Once all are there.
  void dress();
  /// Asks each command whether it can be used now. Done by itself for another case, image, step or vessel.
  void refresh();

  const std::vector<Command>& all() const { return all_; }
  /// Those of `ids` come first, in this order, in `all`.
  void arrange(const QStringList& ids);
  const Command* find(const QString& id) const;  ///< null: there is none
  /// Throws std::logic_error where there is none.
  QAction& action(const QString& id) const;
  /// Why it cannot be used now; empty where it can, or where there is nothing to say.
  static QString why_not(const Command& command);

  const ShortcutKeys& keys() const { return keys_; }
  /// At once, for all commands, and kept in the machine's settings.
  void set_keys(const ShortcutKeys& keys);

 private:
  void refresh_tips(const Command& command) const;
  void dress_as(const ShortcutKeys& keys);
  Desk& desk_;
  std::vector<Command> all_;
  ShortcutKeys keys_;
  std::vector<session::Subscription> own_;
};

/// Does a command of the table, and has its text; it is called "button.ID".
QToolButton* command_button(const CommandTable& commands, const QString& id);

/// The menus that lead to the action ("View", "Go to"); empty where none does.
QStringList menus_of(const QAction& action);

}  // namespace ostia::workstation
