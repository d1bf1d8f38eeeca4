#include "measuring/side_lists.h"

#include "shell/language.h"

#include "ostia/core/error.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMap>

namespace ostia::workstation {
namespace {

constexpr int id_role = Qt::UserRole;
constexpr int fill_after_ms = 100;  // of the last change: not with every move of the mouse

/// Of a measurement's item, or of one of its values'.
std::int32_t measurement_of(const QTreeWidgetItem& item) {
  return (item.parent() ? item.parent() : &item)->data(0, id_role).toInt();
}

}  // namespace

QString step_name(const std::string& op) {
  static const QMap<QString, const char*> names{
      {"case.begin", QT_TRANSLATE_NOOP("steps", "Start")},
      {"cpr.stroke", QT_TRANSLATE_NOOP("steps", "Draw on CPR")},
      {"section.contour", QT_TRANSLATE_NOOP("steps", "Draw on section")},
      {"wall.drag", QT_TRANSLATE_NOOP("steps", "Pull the wall")},
      {"wall.push", QT_TRANSLATE_NOOP("steps", "Brush")},
      {"axis.move", QT_TRANSLATE_NOOP("steps", "Move the centerline")},
      {"axis.insert", QT_TRANSLATE_NOOP("steps", "Add a control point")},
      {"axis.delete", QT_TRANSLATE_NOOP("steps", "Delete a control point")},
      {"axis.extend", QT_TRANSLATE_NOOP("steps", "Extend the vessel")},
      {"axis.trim", QT_TRANSLATE_NOOP("steps", "Cut the vessel off")},
      {"branch.add", QT_TRANSLATE_NOOP("steps", "Add a vessel")},
      {"branch.delete", QT_TRANSLATE_NOOP("steps", "Delete a vessel")},
      {"branch.attach", QT_TRANSLATE_NOOP("steps", "Join a vessel elsewhere")},
      {"branch.split", QT_TRANSLATE_NOOP("steps", "Split a vessel")},
      {"branch.merge", QT_TRANSLATE_NOOP("steps", "Join a vessel with its parent")},
      {"branch.cut", QT_TRANSLATE_NOOP("steps", "Cut a vessel in two")},
      {"branch.connect", QT_TRANSLATE_NOOP("steps", "Connect a vessel")},
      {"vessel.rename", QT_TRANSLATE_NOOP("steps", "Rename a vessel")},
      {"vessel.mark", QT_TRANSLATE_NOOP("steps", "Mark a vessel")},
      {"measure.add", QT_TRANSLATE_NOOP("steps", "Measure")},
      {"measure.change", QT_TRANSLATE_NOOP("steps", "Change a measurement")},
      {"measure.delete", QT_TRANSLATE_NOOP("steps", "Delete a measurement")}};
  const QString key = QString::fromStdString(op);
  const auto found = names.find(key);
  return found == names.end() ? key : QCoreApplication::translate("steps", *found);
}

QTreeWidgetItem& row_of(QTreeWidget& list, std::int32_t id, int row) {
  int found = row;
  while (found < list.topLevelItemCount() && list.topLevelItem(found)->data(0, id_role).toInt() != id)
    ++found;
  if (found < list.topLevelItemCount()) {
    for (; found > row; --found) delete list.topLevelItem(row);
    return *list.topLevelItem(row);
  }
  auto* item = new QTreeWidgetItem;
  item->setData(0, id_role, id);
  item->setFlags(item->flags() | Qt::ItemIsUserCheckable | Qt::ItemIsEditable);
  list.insertTopLevelItem(row, item);
  return *item;
}

StepList::StepList(session::Workbench& bench, Guard guard, QWidget* parent)
    : QListWidget(parent), bench_(bench), guard_(std::move(guard)) {
  setObjectName("steps");
  setAccessibleName(tr("Steps"));
  setToolTip(tr("Click: go back or forth to this step"));
  setUniformItemSizes(true);
  own_.push_back(bench.case_changed.observe([this] { fill(); }));
  own_.push_back(bench.steps_changed.observe([this] { soon_.start(); }));
  soon_.setSingleShot(true);
  soon_.setInterval(fill_after_ms);
  connect(&soon_, &QTimer::timeout, this, &StepList::fill);
  connect(this, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) { go_to(*item); });
  connect(this, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) { go_to(*item); });
}

void StepList::go_to(const QListWidgetItem& step) {
  const qlonglong number = step.data(id_role).toLongLong();
  guard_([&] { bench_.go_to_step(number); });
}

void StepList::fill() {
  last_ = nullptr;
  clear();
  if (!bench_.has_case()) return;
  for (const session::JournalEntry& step : bench_.session().file().journal()) {
    if (step.kind == session::StepKind::travel || step.dropped) continue;
    auto* item = new QListWidgetItem(step_name(step.op), this);
    item->setData(id_role, static_cast<qlonglong>(step.number));
    if (step.undone) item->setForeground(palette().color(QPalette::Disabled, QPalette::Text));
    if (!step.notes.empty()) item->setToolTip(QString::fromStdString(step.notes.front()));
    if (!step.undone) last_ = item;
  }
  if (!last_) return;
  QFont marked = font();
  marked.setBold(true);
  last_->setFont(marked);
  select_last();
}

void StepList::select_last() {
  if (!last_) return;
  setCurrentItem(last_);
  scrollToItem(last_);
}

/// What the keys chose, and was not gone to, is no longer of interest.
void StepList::focusOutEvent(QFocusEvent* event) {
  QListWidget::focusOutEvent(event);
  select_last();
}

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
  soon_.setInterval(fill_after_ms);
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
    item.child(i)->setText(0, measure_word(value.name));
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
