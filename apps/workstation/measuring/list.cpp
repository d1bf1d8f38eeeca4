#include "measuring/list.h"

#include "shell/language.h"
#include "shell/list_rows.h"

#include "ostia/core/error.h"

#include <QHeaderView>
#include <QKeyEvent>

namespace ostia::workstation {
namespace {

constexpr int fill_measurements_after_ms = 100;  // of the last change: not with every move of the mouse

/// Of a measurement's item, or of one of its values'.
std::int32_t measurement_of(const QTreeWidgetItem& item) {
  return (item.parent() ? item.parent() : &item)->data(0, row_id_role).toInt();
}

}  // namespace

MeasurementList::MeasurementList(session::Workbench& bench, Guard guard, QWidget* parent)
    : QTreeWidget(parent), bench_(bench), guard_(std::move(guard)) {
  setObjectName("measurements");
  setAccessibleName(tr("Measurements"));
  setColumnCount(2);
  setHeaderLabels({tr("Measurement"), tr("Value")});
  header()->setSectionResizeMode(0, QHeaderView::Stretch);
  header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  header()->setStretchLastSection(false);
  setEditTriggers(EditKeyPressed);
  own_.push_back(bench.case_changed.observe([this] {
    filling_ = true;  // a name that is being typed is not for another case's measurement
    clear();
    fill();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { soon_.start(); }));
  soon_.setSingleShot(true);
  soon_.setInterval(fill_measurements_after_ms);
  connect(&soon_, &QTimer::timeout, this, &MeasurementList::fill);
  own_.push_back(bench.annotations_changed.observe([this] { soon_.start(); }));
  own_.push_back(bench.image_changed.observe([this] { fill(); }));
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item && !filling_) bench_.selected_measurement.set(measurement_of(*item));
  });
  const auto go = [this](QTreeWidgetItem* item) { go_to(measurement_of(*item)); };
  connect(this, &QTreeWidget::itemDoubleClicked, this, go);
  connect(this, &QTreeWidget::itemActivated, this, go);
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (!filling_ && column == 0 && !item->parent()) renamed(*item);
  });
}

void MeasurementList::renamed(const QTreeWidgetItem& item) {
  guard_([&] {
    const auto annotations = bench_.session().file().annotations();
    const analysis::Measurement* found = session::find_measurement(*annotations, measurement_of(item));
    if (!found) return;
    analysis::Measurement changed = *found;
    changed.name = item.text(0).trimmed().toStdString();
    if (changed.name != found->name) bench_.annotate(session::MeasureChange{changed});
  });
}

/// Rows that are there are written anew: what is unfolded, selected, or being renamed stays so.
void MeasurementList::fill() {
  filling_ = true;
  int rows = 0;
  if (bench_.has_case()) {
    const auto annotations = bench_.session().file().annotations();
    for (const analysis::Measurement& one : annotations->measurements) {
      QTreeWidgetItem& item = row_of(*this, one.id, rows++);
      show_name(item, one);
      show_values(item, one);
      const bool selected = one.id == bench_.selected_measurement.get();
      if (selected && state() != EditingState && (!currentItem() || measurement_of(*currentItem()) != one.id))
        setCurrentItem(&item);
    }
  }
  while (topLevelItemCount() > rows) delete topLevelItem(topLevelItemCount() - 1);
  // Where the selected one went, the keys must not reach its neighbour.
  if (currentItem() && state() != EditingState &&
      measurement_of(*currentItem()) != bench_.selected_measurement.get())
    setCurrentItem(nullptr);
  viewport()->update();  // an emptied tree leaves rows on the screen else
  filling_ = false;
}

void MeasurementList::show_name(QTreeWidgetItem& item, const analysis::Measurement& one) {
  if (state() == EditingState && currentItem() == &item) return;
  item.setText(0, one.name.empty()
                      ? QStringLiteral("%1 %2").arg(measure_word(analysis::to_string(one.kind))).arg(one.id)
                      : QString::fromStdString(one.name));
}

void MeasurementList::show_values(QTreeWidgetItem& item, const analysis::Measurement& one) {
  std::vector<analysis::MeasuredValue> values;
  QString first, fault;
  try {
    values = bench_.measured(one);
    if (!values.empty()) first = QString::fromStdString(analysis::to_text(values.front()));
  } catch (const Error& error) {
    first = QStringLiteral("\u2013");
    fault = QString::fromStdString(error.what());
  }
  item.setText(1, first);
  item.setToolTip(1, fault);
  const int lines = static_cast<int>(values.size());
  while (item.childCount() > lines) delete item.child(item.childCount() - 1);
  while (item.childCount() < lines) new QTreeWidgetItem(&item);
  for (int i = 0; i < lines; ++i) {
    const analysis::MeasuredValue& value = values[static_cast<std::size_t>(i)];
    const QString name = measure_word(value.name);
    item.child(i)->setText(0, name);
    item.child(i)->setToolTip(0, name);  // a narrow window cuts it off
    item.child(i)->setText(1, QString::fromStdString(analysis::to_text(value)));
  }
}

/// What was not written while the name was typed.
void MeasurementList::closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) {
  QTreeWidget::closeEditor(editor, hint);
  soon_.start();
}

void MeasurementList::go_to(std::int32_t measurement) {
  if (!bench_.has_case()) return;
  const auto annotations = bench_.session().file().annotations();
  const analysis::Measurement* found = session::find_measurement(*annotations, measurement);
  if (!found) return;
  bench_.selected_measurement.set(measurement);
  const auto axis = session::needs_vessel(*found) ? bench_.axis(found->vessel) : nullptr;
  if (axis) {
    bench_.vessel.set(found->vessel);
    bench_.cursor_mm.set(found->points.empty() ? bench_.here_mm(0.5 * (found->from_mm + found->to_mm))
                                               : axis->nearest_foot(found->points.front()).s_mm);
  } else if (!found->points.empty()) {
    bench_.place.set(found->points.front());
  }
}

void MeasurementList::remove_current() {
  QTreeWidgetItem* item = currentItem();
  if (!item) return;
  const std::int32_t id = measurement_of(*item);
  guard_([&] { bench_.annotate(session::MeasureDelete{id}); });
}

void MeasurementList::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete)
    remove_current();
  else
    QTreeWidget::keyPressEvent(event);
}

}  // namespace ostia::workstation
