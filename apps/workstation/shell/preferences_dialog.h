#pragma once
/// \file Preferences: keys, theme, language.

#include "commands/shortcuts.h"

#include <QDialog>

class QComboBox;
class QFormLayout;
class QKeySequenceEdit;
class QLabel;
class QTreeWidget;
class QTreeWidgetItem;

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// What is changed holds at once; a language from the next start on.
class PreferencesDialog final : public QDialog {
  Q_OBJECT
 public:
  PreferencesDialog(Desk& desk, CommandTable& commands);

 private:
  QWidget* general_page();
  void add_patients(QFormLayout& form);
  void add_author(QFormLayout& form);
  QWidget* keys_page();
  void fill_keys();
  void show_keys();
  QString current() const;
  QString name_of(const QString& id) const;
  void take(const QKeySequence& keys);
  void reset();
  void reset_all();
  void choose_scheme(int index);
  void complain(const QString& text);
  Desk& desk_;
  CommandTable& commands_;
  ShortcutKeys keys_;
  QComboBox* scheme_ = nullptr;
  QTreeWidget* list_ = nullptr;
  QKeySequenceEdit* editor_ = nullptr;
  QLabel* trouble_ = nullptr;
};

}  // namespace ostia::workstation
