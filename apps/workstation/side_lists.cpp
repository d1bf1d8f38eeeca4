#include "side_lists.h"

#include "language.h"

#include "ostia/core/error.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMap>
#include <QSignalBlocker>

namespace ostia::workstation {
namespace {

constexpr int id_role = Qt::UserRole;
constexpr int fill_after_ms = 100;  // of the last change: not with every move of the mouse

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
      {"vessel.rename", QT_TRANSLATE_NOOP("steps", "Rename a vessel")},
      {"vessel.mark", QT_TRANSLATE_NOOP("steps", "Mark a vessel")},
      {"measure.add", QT_TRANSLATE_NOOP("steps", "Measure")},
      {"measure.change", QT_TRANSLATE_NOOP("steps", "Change a measurement")},
      {"measure.delete", QT_TRANSLATE_NOOP("steps", "Delete a measurement")}};
  const QString key = QString::fromStdString(op);
  const auto found = names.find(key);
  return found == names.end() ? key : QCoreApplication::translate("steps", *found);
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
  connect(this, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) {
    const qlonglong number = item->data(id_role).toLongLong();
    guard_([&] { bench_.go_to_step(number); });
  });
}

void StepList::fill() {
  const QSignalBlocker quiet(this);
  clear();
  if (!bench_.has_case()) return;
  QListWidgetItem* last = nullptr;
  for (const session::JournalEntry& step : bench_.session().file().journal()) {
    if (step.kind == session::StepKind::travel || step.dropped) continue;
    auto* item = new QListWidgetItem(step_name(step.op), this);
    item->setData(id_role, static_cast<qlonglong>(step.number));
    if (step.undone) item->setForeground(palette().color(QPalette::Disabled, QPalette::Text));
    if (!step.notes.empty()) item->setToolTip(QString::fromStdString(step.notes.front()));
    if (!step.undone) last = item;
  }
  if (last) {
    setCurrentItem(last);
    scrollToItem(last);
  }
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
  own_.push_back(bench.case_changed.observe([this] { fill(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { soon_.start(); }));
  soon_.setSingleShot(true);
  soon_.setInterval(fill_after_ms);
  connect(&soon_, &QTimer::timeout, this, &MeasurementList::fill);
  own_.push_back(bench.annotations_changed.observe([this] { soon_.start(); }));
  own_.push_back(bench.image_changed.observe([this] { fill(); }));
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item && !filling_)
      bench_.selected_measurement.set((item->parent() ? item->parent() : item)->data(0, id_role).toInt());
  });
  connect(this, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item) {
    go_to((item->parent() ? item->parent() : item)->data(0, id_role).toInt());
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (filling_ || column != 0 || item->parent()) return;
    guard_([&] {
      const auto annotations = bench_.session().file().annotations();
      const analysis::Measurement* found =
          session::find_measurement(*annotations, item->data(0, id_role).toInt());
      if (!found) return;
      analysis::Measurement renamed = *found;
      renamed.name = item->text(0).trimmed().toStdString();
      if (renamed.name != found->name) bench_.annotate(session::MeasureChange{renamed});
    });
  });
}

void MeasurementList::fill() {
  const QSignalBlocker quiet(this);
  filling_ = true;
  clear();
  if (bench_.has_case()) {
    const auto annotations = bench_.session().file().annotations();
    for (const analysis::Measurement& one : annotations->measurements) {
      auto* item = new QTreeWidgetItem(this);
      item->setData(0, id_role, one.id);
      const QString name =
          one.name.empty()
              ? QStringLiteral("%1 %2").arg(measure_word(analysis::to_string(one.kind))).arg(one.id)
              : QString::fromStdString(one.name);
      item->setText(0, name);
      item->setFlags(item->flags() | Qt::ItemIsEditable);
      try {
        const std::vector<analysis::MeasuredValue> values = bench_.measured(one);
        if (!values.empty()) item->setText(1, QString::fromStdString(analysis::to_text(values.front())));
        for (const analysis::MeasuredValue& value : values) {
          auto* line = new QTreeWidgetItem(item);
          line->setText(0, measure_word(value.name));
          line->setText(1, QString::fromStdString(analysis::to_text(value)));
        }
      } catch (const Error& error) {
        item->setText(1, QStringLiteral("\u2013"));
        item->setToolTip(1, QString::fromStdString(error.what()));
      }
      if (one.id == bench_.selected_measurement.get()) setCurrentItem(item);
    }
  }
  filling_ = false;
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
    bench_.cursor_mm.set(found->points.empty() ? 0.5 * (found->from_mm + found->to_mm)
                                               : axis->nearest_foot(found->points.front()).s_mm);
  } else if (!found->points.empty()) {
    bench_.place.set(found->points.front());
  }
}

void MeasurementList::remove_current() {
  QTreeWidgetItem* item = currentItem();
  if (!item) return;
  const std::int32_t id = (item->parent() ? item->parent() : item)->data(0, id_role).toInt();
  guard_([&] { bench_.annotate(session::MeasureDelete{id}); });
}

void MeasurementList::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete)
    remove_current();
  else
    QTreeWidget::keyPressEvent(event);
}

}  // namespace ostia::workstation
