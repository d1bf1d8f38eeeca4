#pragma once
/// \file The command palette: type what you want to do, see its key and its menu, and do it.

#include "commands/search.h"

#include <QFrame>
#include <vector>

class QLabel;
class QLineEdit;
class QListView;

namespace ostia::workstation {

class CommandTable;
class PaletteModel;
struct Command;

/// A command that fits what was typed.
struct PaletteLine {
  const Command* command = nullptr;
  Match match;
};
/// The best first, and of those that fit as well first those that can be used; else in the table's order. The
/// command that opens the palette is none of them.
std::vector<PaletteLine> palette_lines(const CommandTable& commands, const QString& typed);

/// Comes up over the window and goes when a command was chosen, by Esc, or by a click beside it. The keyboard
/// is then where it was. Deletes itself.
class Palette final : public QFrame {
  Q_OBJECT
 public:
  Palette(const CommandTable& commands, QWidget& window);
  void begin();

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 private:
  void fill(const QString& typed);
  void place();
  bool take_key(int key);
  void move(int rows);
  void run(int row);
  void show_hint();
  const CommandTable& commands_;
  QWidget& window_;
  QLineEdit* line_;
  QListView* list_;
  QLabel* hint_;
  PaletteModel* model_;
};

}  // namespace ostia::workstation
