#include "shell/list_rows.h"

namespace ostia::workstation {

QTreeWidgetItem& row_of(QTreeWidget& list, std::int32_t id, int row) {
  int found = row;
  while (found < list.topLevelItemCount() && list.topLevelItem(found)->data(0, row_id_role).toInt() != id)
    ++found;
  if (found < list.topLevelItemCount()) {
    for (; found > row; --found) delete list.topLevelItem(row);
    return *list.topLevelItem(row);
  }
  auto* item = new QTreeWidgetItem;
  item->setData(0, row_id_role, id);
  item->setFlags(item->flags() | Qt::ItemIsUserCheckable | Qt::ItemIsEditable);
  list.insertTopLevelItem(row, item);
  return *item;
}

}  // namespace ostia::workstation
