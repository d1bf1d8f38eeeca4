#pragma once
/// \file The table of lesions beside the profile.

#include "vessels/measuring_turns.h"
#include "views/picture_widget.h"

#include "ostia/session/lesion_board.h"
#include "ostia/session/pressure_board.h"

#include <QTimer>
#include <QTreeWidget>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QLineEdit;

namespace ostia::workstation {

/// One row a lesion; a row that is chosen brings all views to its throat. Sorts by a click on a column, and
/// shows those rows alone that a text and a state let through.
class LesionList final : public QTreeWidget {
  Q_OBJECT
 public:
  LesionList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  /// Where the lesions come from; it has to outlive the list, or null is set before it goes.
  void show_lesions(session::LesionBoard* board);
  /// While it is shown, a column has FFR behind each lesion; it has to outlive the list, or null is set.
  void show_pressures(session::PressureBoard* board);
  /// What filters the rows and tells what is missing; for a title beside which they stand.
  QWidget* controls();

  /// To the next row as they are sorted, or the one before (`by` -1); false where there is none.
  bool walk(int by);
  /// The lesion that the cursor is in on its vessel; nothing where it is in none.
  std::optional<session::LesionRow> at_cursor();
  /// The reader's word on that lesion; false where there is none.
  bool say(session::LesionState state);
  bool comment();                                     ///< opens the comment of that lesion for typing
  bool settled() const { return !soon_.isActive(); }  ///< nothing that was found waits to be written
  QString as_text() const;  ///< of the rows that are shown, in their order: tab-separated, with a header

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 protected slots:
  void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;

 private:
  void fill();
  void give_comments_room();
  void show_row(QTreeWidgetItem& item, const session::LesionRow& row);
  void show_ffr();
  void filter();
  void follow_cursor();
  void go_to(const session::LesionRow& row);
  void commented(const QTreeWidgetItem& item);
  std::vector<QTreeWidgetItem*> shown_items() const;
  const session::LesionRow* row_of(const QTreeWidgetItem& item) const;
  QTreeWidgetItem* item_at_cursor() const;
  session::Workbench& bench_;
  Guard guard_;
  session::LesionBoard* board_ = nullptr;
  session::PressureBoard* pressures_ = nullptr;
  QWidget* controls_ = nullptr;
  QLineEdit* wanted_text_ = nullptr;
  QComboBox* wanted_state_ = nullptr;
  QLabel* missing_ = nullptr;
  std::vector<session::LesionRow> rows_;
  bool filling_ = false;
  QTimer soon_;
  MeasuringTurns turns_;
  std::vector<session::Subscription> own_, of_board_, of_pressures_;
};

}  // namespace ostia::workstation
