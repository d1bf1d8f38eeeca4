#pragma once
/// \file All keys and mouse gestures on one page.

#include <QDialog>

class QLineEdit;
class QTreeWidget;

namespace ostia::workstation {

class CommandTable;

class ShortcutsPage final : public QDialog {
  Q_OBJECT
 public:
  ShortcutsPage(const CommandTable& commands, QWidget* parent);

 private:
  void fill(const CommandTable& commands);
  void search(const QString& text);
  QLineEdit* search_;
  QTreeWidget* list_;
};

}  // namespace ostia::workstation
