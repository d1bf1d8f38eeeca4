#include "shell/step_list.h"

#include "shell/library_texts.h"
#include "shell/list_rows.h"

#include "ostia/session/case_report.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QMap>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>

namespace ostia::workstation {
namespace {

constexpr int step_number_role = Qt::UserRole;
constexpr int detail_role = Qt::UserRole + 1;
constexpr int fill_steps_after_ms = 100;  // of the last change: not with every move of the mouse

/// What was done and, at the right edge where there is room, its vessel, time and author.
class StepRow final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyledItemDelegate::paint(painter, option, index);
    QStyleOptionViewItem row = option;
    initStyleOption(&row, index);
    constexpr int margin = 6, between = 14;
    const QString detail = index.data(detail_role).toString();
    const int room = row.rect.width() - row.fontMetrics.horizontalAdvance(row.text) - 2 * margin - between;
    const QString fitting = option.fontMetrics.elidedText(detail, Qt::ElideRight, room);
    if (room < 2 * between || fitting.isEmpty()) return;
    const bool selected = row.state & QStyle::State_Selected;
    painter->save();
    painter->setFont(option.font);
    painter->setPen(row.palette.color(selected ? QPalette::Normal : QPalette::Disabled,
                                      selected ? QPalette::HighlightedText : QPalette::Text));
    painter->drawText(row.rect.adjusted(0, 0, -margin, 0), Qt::AlignRight | Qt::AlignVCenter, fitting);
    painter->restore();
  }
};

/// "14:03", of another day with its date.
QString shown_time(const QDateTime& when) {
  if (!when.isValid()) return {};
  const bool today = when.date() == QDate::currentDate();
  return when.toString(today ? QStringLiteral("HH:mm") : QStringLiteral("yyyy-MM-dd HH:mm"));
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
      {"vessel.add", QT_TRANSLATE_NOOP("steps", "Add an artery")},
      {"vessel.mark", QT_TRANSLATE_NOOP("steps", "Mark a vessel")},
      {"measure.add", QT_TRANSLATE_NOOP("steps", "Measure")},
      {"measure.change", QT_TRANSLATE_NOOP("steps", "Change a measurement")},
      {"pressure.inputs", QT_TRANSLATE_NOOP("steps", "Inputs of the pressures")},
      {"pressure.what_if", QT_TRANSLATE_NOOP("steps", "What if, of the pressures")},
      {"report.impression", QT_TRANSLATE_NOOP("steps", "Impression of the report")},
      {"report.modifiers", QT_TRANSLATE_NOOP("steps", "Modifiers of CAD-RADS")},
      {"report.features", QT_TRANSLATE_NOOP("steps", "Features of plaque")},
      {"calcium.places", QT_TRANSLATE_NOOP("steps", "Place of a lesion of calcium")},
      {"report.sign", QT_TRANSLATE_NOOP("steps", "Sign the report")},
      {"plugin", QT_TRANSLATE_NOOP("steps", "Plug-in")},
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
  setItemDelegate(new StepRow(this));
  own_.push_back(bench.case_changed.observe([this] {
    vessels_.clear();
    fill();
  }));
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

QWidget* StepList::with_filter() {
  return below_filter(*this, "steps_filter", tr("Filter the steps"), tr("Filter"),
                      [this](const QString& text) {
                        wanted_ = text;
                        filter();
                      });
}

QString StepList::vessel_of(const session::JournalEntry& step) {
  auto known = vessels_.find(step.number);
  if (known == vessels_.end())
    known = vessels_.emplace(step.number, session::vessel_of_step(step).value_or(-1)).first;
  return known->second < 0 ? QString() : QString::fromStdString(bench_.vessel_name(known->second));
}

/// Hides the rows in which the words that are wanted are not, in any order.
void StepList::filter() {
  const QStringList words = wanted_.split(' ', Qt::SkipEmptyParts);
  for (int row = 0; row < count(); ++row) {
    const QString text = item(row)->data(Qt::AccessibleTextRole).toString();
    item(row)->setHidden(!std::all_of(words.begin(), words.end(), [&](const QString& word) {
      return text.contains(word, Qt::CaseInsensitive);
    }));
  }
}

void StepList::fill() {
  last_ = nullptr;
  clear();
  if (!bench_.has_case()) return;
  for (const session::JournalEntry& step : bench_.session().file().journal()) {
    if (step.kind == session::StepKind::travel || step.dropped) continue;
    QString name = step_name(step.op);
    if (step.op == session::plugin_op)
      name += QStringLiteral(": ") + QString::fromStdString(session::plugin_named_in(step.parameters));
    auto* item = new QListWidgetItem(name, this);
    item->setData(step_number_role, static_cast<qlonglong>(step.number));
    if (step.undone) item->setForeground(palette().color(QPalette::Disabled, QPalette::Text));
    const QDateTime when = step.time_s > 0 ? QDateTime::fromSecsSinceEpoch(step.time_s) : QDateTime();
    QStringList details{vessel_of(step), shown_time(when), QString::fromStdString(step.author)};
    details.removeAll(QString());
    item->setData(detail_role, details.join(QStringLiteral("  \u00b7  ")));
    QStringList tip{name};
    if (!details.isEmpty()) tip << details.join(QStringLiteral(", "));
    item->setData(Qt::AccessibleTextRole, tip.join(QStringLiteral(", ")));
    for (const std::string& note : step.notes) tip << library_text(note);
    item->setToolTip(tip.join('\n'));
    if (!step.undone) last_ = item;
  }
  filter();
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
