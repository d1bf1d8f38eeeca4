#pragma once
/// \file The lesions of two scans: in both, new, gone, or where one of the scans does not reach.

#include "ostia/session/comparison.h"

#include <QStringList>
#include <QWidget>
#include <memory>
#include <vector>

class QTreeWidget;

namespace ostia::workstation {

/// What the table's columns are, and what a lesion's cells say: as the window and the report show them.
QStringList lesion_change_columns();
QStringList lesion_change_cells(const session::Comparison& made, const analysis::LesionChange& lesion);

class LesionChanges final : public QWidget {
  Q_OBJECT
 public:
  explicit LesionChanges(QWidget* parent = nullptr);
  void show_comparison(const std::shared_ptr<const session::Comparison>& made);
  /// The next or the one before in the list, round its ends.
  void step(int by);

 signals:
  void chosen(int lesion);  ///< index of ScanChange::lesions

 private:
  QTreeWidget* table_ = nullptr;
  bool filling_ = false;
};

}  // namespace ostia::workstation
