#pragma once
/// \file The list of measurements.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

#include <QStringList>
#include <QTimer>
#include <QTreeWidget>
#include <vector>

namespace ostia::workstation {

/// Measurements and remarks with their values; selects, renames, deletes, goes there, sorts by a click on a
/// column (a third one: as they were made), filters, copies. An arrow or a note that was just placed asks for
/// its text.
class MeasurementList final : public QTreeWidget {
  Q_OBJECT
 public:
  MeasurementList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  void go_to(std::int32_t measurement);
  QWidget* with_filter();   ///< the list below a line that filters it, to be shown instead of it
  QString as_text() const;  ///< of what is shown: name, quantity and value, with tabs, one a line

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 protected slots:
  void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;

 private:
  void fill();
  std::vector<analysis::Measurement> in_order() const;
  void sort_by(int column);
  void filter();
  void ask_for_text(const std::vector<analysis::Measurement>& all);
  void show_name(QTreeWidgetItem& item, const analysis::Measurement& one);
  void show_values(QTreeWidgetItem& item, const analysis::Measurement& one);
  void renamed(const QTreeWidgetItem& item);
  void remove_current();
  session::Workbench& bench_;
  Guard guard_;
  bool filling_ = false;
  int sorted_by_ = -1;  // a column; -1: as they were made
  bool descending_ = false;
  std::int32_t newest_ = -1;  // of those that the list has seen; -1: none yet of this case
  QString wanted_;            // text that a row must have
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
