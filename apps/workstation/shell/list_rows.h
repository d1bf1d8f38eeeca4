#pragma once
/// \file Lists: tables of figures, and rows that are written anew while they are being used.

#include <QTreeWidget>
#include <cstdint>
#include <functional>

namespace ostia::workstation {

/// Flat, with columns as wide as their texts; may be as low as its head and a row.
QTreeWidget* figures_table(const QString& name, const QString& title, const QStringList& columns);

constexpr int row_id_role = Qt::UserRole;  ///< of a row's first column: the id of what it shows

/// The item of this id at this row of a list that is written anew from the top: the one that is there, in
/// front of which those that are of nothing any more go, or a new one.
QTreeWidgetItem& row_of(QTreeWidget& list, std::int32_t id, int row);

/// The list below a line that filters it, to be shown instead of it. `filter` is told what was typed; Return
/// there leads to the list.
QWidget* below_filter(QAbstractItemView& list, const QString& name, const QString& accessible_name,
                      const QString& placeholder, std::function<void(const QString&)> filter);

}  // namespace ostia::workstation
