#pragma once
/// \file What a command is: all that menus, keys, tool tips, the page of keys and the palette know of it.

#include <QAction>
#include <QCoreApplication>
#include <QString>
#include <functional>

namespace ostia::workstation {

/// Several keys of one command with "; " between.
struct DefaultKeys {
  QString pacs{};      ///< as a reading station has them
  QString research{};  ///< as research software has them; empty: as `pacs`
};

/// One row of the table. Texts are in the person's language: `Command::tr`.
struct Command {
  QString id{};    ///< "file.open": the action's object name, and its name in the settings of keys
  QString text{};  ///< as menus show it, with mnemonic
  QString tip{};   ///< one sentence on what it does; empty where the text says all
  DefaultKeys keys{};
  /// What is thrown is said by the window. Empty where `bind` or `action` does it.
  std::function<void()> run{};
  std::function<bool()> enabled{};     ///< empty: always
  std::function<QString()> why_not{};  ///< asked while it is not enabled; empty: nothing to say
  /// Makes the action checkable and keeps its mark and what it stands for the same.
  std::function<void(QAction&)> bind{};
  QAction* action = nullptr;  ///< one that is there already (a dock's); null: the table makes one

  Q_DECLARE_TR_FUNCTIONS(ostia::workstation::Command)
};

}  // namespace ostia::workstation
