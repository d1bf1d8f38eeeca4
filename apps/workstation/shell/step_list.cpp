#include "shell/step_list.h"

#include <QCoreApplication>
#include <QMap>

namespace ostia::workstation {
namespace {

constexpr int step_number_role = Qt::UserRole;
constexpr int fill_steps_after_ms = 100;  // of the last change: not with every move of the mouse

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
      {"vessel.add", QT_TRANSLATE_NOOP("steps", "Add an artery")},
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
  soon_.setInterval(fill_steps_after_ms);
  connect(&soon_, &QTimer::timeout, this, &StepList::fill);
  connect(this, &QListWidget::itemClicked, this, [this](QListWidgetItem* item) { go_to(*item); });
  connect(this, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) { go_to(*item); });
}

void StepList::go_to(const QListWidgetItem& step) {
  const qlonglong number = step.data(step_number_role).toLongLong();
  guard_([&] { bench_.go_to_step(number); });
}

void StepList::fill() {
  last_ = nullptr;
  clear();
  if (!bench_.has_case()) return;
  for (const session::JournalEntry& step : bench_.session().file().journal()) {
    if (step.kind == session::StepKind::travel || step.dropped) continue;
    auto* item = new QListWidgetItem(step_name(step.op), this);
    item->setData(step_number_role, static_cast<qlonglong>(step.number));
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

}  // namespace ostia::workstation
