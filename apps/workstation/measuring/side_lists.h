#pragma once
/// \file The lists beside the views: steps that were done, and measurements.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

#include <QListWidget>
#include <QTimer>
#include <QTreeWidget>
#include <vector>

namespace ostia::workstation {

/// In the words of the interface: "Draw on CPR", "Pull the wall", ...
QString step_name(const std::string& op);

/// The item of this id (in Qt::UserRole of the first column) at this row of a list that is written anew from
/// the top: the one that is there, in front of which those that are of nothing any more go, or a new one.
QTreeWidgetItem& row_of(QTreeWidget& list, std::int32_t id, int row);

/// All steps of the case, the last one done in bold; a click, or Return, goes there.
class StepList final : public QListWidget {
  Q_OBJECT
 public:
  StepList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void fill();
  void go_to(const QListWidgetItem& step);
  void select_last();
  session::Workbench& bench_;
  Guard guard_;
  QListWidgetItem* last_ = nullptr;  // done
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

/// Measurements with their values; selects, renames, deletes, goes there.
class MeasurementList final : public QTreeWidget {
  Q_OBJECT
 public:
  MeasurementList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  void go_to(std::int32_t measurement);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 protected slots:
  void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;

 private:
  void fill();
  void show_name(QTreeWidgetItem& item, const analysis::Measurement& one);
  void show_values(QTreeWidgetItem& item, const analysis::Measurement& one);
  void renamed(const QTreeWidgetItem& item);
  void remove_current();
  session::Workbench& bench_;
  Guard guard_;
  bool filling_ = false;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
