#include "comparison/lesion_changes.h"

#include "shell/list_rows.h"
#include "shell/quantities.h"
#include "views/overlay_colors.h"

#include <QScopedValueRollback>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

using analysis::ChangeMeasure;
using analysis::LesionFate;

using NumberText = QString (*)(quantity::Number);

/// "3.10 -> 2.40 *" with an arrow; the star where the difference is real.
QString both_values(const analysis::StretchChange& change, ChangeMeasure measure, NumberText text) {
  const analysis::Difference& one = analysis::of(change, measure);
  if (!one.before && !one.after) return {};
  const analysis::ChangeVerdict verdict = one.verdict();
  const bool real = verdict == analysis::ChangeVerdict::less || verdict == analysis::ChangeVerdict::more;
  return text(one.before) + QStringLiteral(" \u2192 ") + text(one.after) +
         (real ? QStringLiteral(" *") : QString());
}

QString labels_of(const std::vector<std::size_t>& which, const session::ComparedCase& of) {
  QStringList labels;
  for (const std::size_t i : which) labels << QString::fromStdString(of.tree.lesions[i].label);
  return labels.join(QStringLiteral(", "));
}

QString fate_word(LesionFate fate) {
  switch (fate) {
    case LesionFate::both:
      return LesionChanges::tr("in both");
    case LesionFate::appeared:
      return LesionChanges::tr("new");
    case LesionFate::gone:
      return LesionChanges::tr("gone");
    case LesionFate::before_unseen:
      return LesionChanges::tr("not reached before");
    case LesionFate::after_unseen:
      break;
  }
  return LesionChanges::tr("not reached now");
}

view::Role role_of_fate(LesionFate fate) {
  switch (fate) {
    case LesionFate::appeared:
      return view::Role::stenosis;
    case LesionFate::gone:
      return view::Role::reference;
    case LesionFate::both:
      return view::Role::diameter;
    default:
      return view::Role::grid;
  }
}

}  // namespace

QStringList lesion_change_columns() {
  return {LesionChanges::tr("Lesion"),
          LesionChanges::tr("Vessel"),
          LesionChanges::tr("Before \u2192 now"),
          LesionChanges::tr("MLD, mm"),
          LesionChanges::tr("MLA, mm\u00b2"),
          LesionChanges::tr("Stenosis, %"),
          LesionChanges::tr("Plaque, mm\u00b3")};
}

QStringList lesion_change_cells(const session::Comparison& made, const analysis::LesionChange& lesion) {
  const QString before = labels_of(lesion.before, made.before), now = labels_of(lesion.after, made.after);
  QString label = before.isEmpty() ? now : before;
  if (lesion.fate == LesionFate::both) label += QStringLiteral(" \u2192 ") + now;
  const QString segment = QString::fromStdString(lesion.segment);
  return {fate_word(lesion.fate),
          segment.isEmpty() ? QString::fromStdString(lesion.vessel_name) : segment,
          label,
          both_values(lesion.change, ChangeMeasure::least_diameter, &quantity::calibre),
          both_values(lesion.change, ChangeMeasure::least_area, &quantity::area),
          both_values(lesion.change, ChangeMeasure::stenosis, &quantity::stenosis),
          both_values(lesion.change, ChangeMeasure::plaque, &quantity::volume)};
}

LesionChanges::LesionChanges(QWidget* parent) : QWidget(parent) {
  table_ = figures_table("compared_lesions", tr("Lesions before and now"), lesion_change_columns());
  table_->setToolTip(
      tr("Both scans go to the lesion. * differs by more than two scans of an unchanged patient "
         "do (smallest real difference, 95 %)."));
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(table_);
  connect(table_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    if (item && !filling_) emit chosen(item->data(0, row_id_role).toInt());
  });
  // Another click on the row leads back to it.
  connect(table_, &QTreeWidget::itemClicked, this,
          [this](const QTreeWidgetItem* item) { emit chosen(item->data(0, row_id_role).toInt()); });
}

void LesionChanges::show_comparison(const std::shared_ptr<const session::Comparison>& made) {
  const QScopedValueRollback<bool> filling(filling_, true);
  table_->clear();
  if (!made) return;
  for (std::size_t i = 0; i < made->change.lesions.size(); ++i) {
    const analysis::LesionChange& lesion = made->change.lesions[i];
    auto* item = new QTreeWidgetItem(table_, lesion_change_cells(*made, lesion));
    item->setIcon(0, color_square(role_color(role_of_fate(lesion.fate), Ground::paper)));
    item->setData(0, row_id_role, static_cast<int>(i));
  }
}

void LesionChanges::step(int by) {
  const int rows = table_->topLevelItemCount();
  if (rows == 0) return;
  const int last = table_->currentItem() ? table_->indexOfTopLevelItem(table_->currentItem()) : -1;
  const int next = last < 0 ? (by > 0 ? 0 : rows - 1) : (last + by + rows) % rows;
  if (next == last)
    emit chosen(table_->currentItem()->data(0, row_id_role).toInt());
  else
    table_->setCurrentItem(table_->topLevelItem(next));
}

}  // namespace ostia::workstation
