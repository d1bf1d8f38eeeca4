#pragma once
/// \file The list of measurements.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

#include <QTimer>
#include <QTreeWidget>
#include <vector>

namespace ostia::workstation {

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
