#include "shell/list_rows.h"

#include <QHeaderView>
#include <QLineEdit>
#include <QVBoxLayout>
#include <utility>

namespace ostia::workstation {

QTreeWidget* figures_table(const QString& name, const QString& title, const QStringList& columns) {
  auto* made = new QTreeWidget;
  made->setObjectName(name);
  made->setAccessibleName(title);
  made->setColumnCount(static_cast<int>(columns.size()));
  made->setHeaderLabels(columns);
  made->setRootIsDecorated(false);
  made->setUniformRowHeights(true);
  made->setAllColumnsShowFocus(true);
  made->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  made->header()->setStretchLastSection(false);
  made->setMinimumSize(120, 40);
  return made;
}

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

QWidget* below_filter(QAbstractItemView& list, const QString& name, const QString& accessible_name,
                      const QString& placeholder, std::function<void(const QString&)> filter) {
  auto* whole = new QWidget;
  auto* column = new QVBoxLayout(whole);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* line = new QLineEdit(whole);
  line->setObjectName(name);
  line->setAccessibleName(accessible_name);
  line->setPlaceholderText(placeholder);
  line->setClearButtonEnabled(true);
  column->addWidget(line);
  column->addWidget(&list, 1);
  QObject::connect(line, &QLineEdit::textChanged, &list,
                   [filter = std::move(filter)](const QString& text) { filter(text.trimmed()); });
  QObject::connect(line, &QLineEdit::returnPressed, &list,
                   [&list] { list.setFocus(Qt::ShortcutFocusReason); });
  return whole;
}

}  // namespace ostia::workstation
