#include "measuring/list.h"

#include "shell/language.h"
#include "shell/list_rows.h"
#include "shell/panel.h"

#include "ostia/core/error.h"
#include "ostia/view/words.h"

#include <QClipboard>
#include <QGuiApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QVBoxLayout>
#include <algorithm>
#include <map>

namespace ostia::workstation {
namespace {

constexpr int fill_measurements_after_ms = 100;  // of the last change: not with every move of the mouse

/// Of a measurement's item, or of one of its values'.
std::int32_t measurement_of(const QTreeWidgetItem& item) {
  return (item.parent() ? item.parent() : &item)->data(0, row_id_role).toInt();
}

/// As the person named it, or else what it is called.
QString shown_name(const analysis::Measurement& one) {
  return one.name.empty()
             ? QStringLiteral("%1 %2").arg(QString::fromStdString(view::words().kind(one.kind))).arg(one.id)
             : QString::fromStdString(one.name);
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
  header()->setSectionsClickable(true);
  connect(header(), &QHeaderView::sectionClicked, this, &MeasurementList::sort_by);
  own_.push_back(bench.case_changed.observe([this] {
    newest_ = -1;
    filling_ = true;  // a name that is being typed is not for another case's measurement
    clear();
    fill();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { soon_.start(); }));
  soon_.setSingleShot(true);
  soon_.setInterval(fill_measurements_after_ms);
  connect(&soon_, &QTimer::timeout, this, [this] {
    if (QGuiApplication::mouseButtons() != Qt::NoButton)
      soon_.start();  // when the hand that pulls lets go
    else
      fill();
  });
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
    const std::vector<analysis::Measurement> all = in_order();
    for (const analysis::Measurement& one : all) {
      QTreeWidgetItem& item = row_of(*this, one.id, rows++);
      show_name(item, one);
      show_values(item, one);
      const bool selected = one.id == bench_.selected_measurement.get();
      if (selected && state() != EditingState && (!currentItem() || measurement_of(*currentItem()) != one.id))
        setCurrentItem(&item);
    }
    ask_for_text(all);
  }
  while (topLevelItemCount() > rows) delete topLevelItem(topLevelItemCount() - 1);
  // Where the selected one went, the keys must not reach its neighbour.
  if (currentItem() && state() != EditingState &&
      measurement_of(*currentItem()) != bench_.selected_measurement.get())
    setCurrentItem(nullptr);
  filter();
  viewport()->update();  // an emptied tree leaves rows on the screen else
  filling_ = false;
}

/// By what the column shows; values of one kind beside each other.
std::vector<analysis::Measurement> MeasurementList::in_order() const {
  std::vector<analysis::Measurement> all = bench_.session().file().annotations()->measurements;
  if (sorted_by_ < 0) return all;
  std::map<std::int32_t, double> value;
  if (sorted_by_ == 1)
    for (const analysis::Measurement& one : all) try {
        const auto values = bench_.measured(one);
        value[one.id] = values.empty() ? 0.0 : values.front().value;
      } catch (const Error&) {
        value[one.id] = 0.0;
      }
  std::stable_sort(
      all.begin(), all.end(), [&](const analysis::Measurement& a, const analysis::Measurement& b) {
        const analysis::Measurement &first = descending_ ? b : a, &then = descending_ ? a : b;
        if (sorted_by_ == 0) return shown_name(first).localeAwareCompare(shown_name(then)) < 0;
        return first.kind != then.kind ? first.kind < then.kind : value[first.id] < value[then.id];
      });
  return all;
}

void MeasurementList::sort_by(int column) {
  if (sorted_by_ != column) {
    sorted_by_ = column;
    descending_ = false;
  } else if (!descending_) {
    descending_ = true;
  } else {
    sorted_by_ = -1;
  }
  header()->setSortIndicatorShown(sorted_by_ >= 0);
  if (sorted_by_ >= 0)
    header()->setSortIndicator(sorted_by_, descending_ ? Qt::DescendingOrder : Qt::AscendingOrder);
  fill();
}

void MeasurementList::filter() {
  const auto has = [this](const QTreeWidgetItem& item) {
    return item.text(0).contains(wanted_, Qt::CaseInsensitive) ||
           item.text(1).contains(wanted_, Qt::CaseInsensitive);
  };
  for (int i = 0; i < topLevelItemCount(); ++i) topLevelItem(i)->setHidden(!has(*topLevelItem(i)));
}

/// Of a remark that has come since the list was written last.
void MeasurementList::ask_for_text(const std::vector<analysis::Measurement>& all) {
  const std::int32_t before = newest_;
  newest_ = 0;
  const analysis::Measurement* last = nullptr;
  for (const analysis::Measurement& one : all)
    if (one.id > newest_) newest_ = one.id, last = &one;
  if (before < 0 || newest_ <= before || !analysis::is_remark(last->kind) || !last->name.empty() ||
      state() == EditingState)
    return;
  for (int i = 0; i < topLevelItemCount(); ++i)
    if (measurement_of(*topLevelItem(i)) == last->id) {
      reveal(*this);
      setFocus();
      setCurrentItem(topLevelItem(i));
      editItem(topLevelItem(i), 0);
    }
}

QWidget* MeasurementList::with_filter() {
  return below_filter(*this, "measurements_filter", tr("Filter the measurements"), tr("Filter"),
                      [this](const QString& text) {
                        wanted_ = text;
                        filter();
                      });
}

QString MeasurementList::as_text() const {
  QString text;
  for (int i = 0; i < topLevelItemCount(); ++i) {
    const QTreeWidgetItem& item = *topLevelItem(i);
    if (item.isHidden()) continue;
    const QString name = item.text(0).simplified();
    if (item.childCount() == 0) text += name + "\t\t" + item.text(1) + '\n';
    for (int k = 0; k < item.childCount(); ++k)
      text += name + '\t' + item.child(k)->text(0) + '\t' + item.child(k)->text(1) + '\n';
  }
  return text;
}

void MeasurementList::show_name(QTreeWidgetItem& item, const analysis::Measurement& one) {
  if (state() == EditingState && currentItem() == &item) return;
  item.setText(0, shown_name(one));
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
  else if (event->matches(QKeySequence::Copy))
    QGuiApplication::clipboard()->setText(as_text());
  else
    QTreeWidget::keyPressEvent(event);
}

}  // namespace ostia::workstation
