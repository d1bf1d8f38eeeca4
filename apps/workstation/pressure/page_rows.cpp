// The rows of the page of pressures.

#include "pressure/live.h"
#include "pressure/page.h"
#include "shell/desk.h"
#include "shell/quantities.h"

#include "ostia/core/text.h"

#include <QTreeWidget>

namespace ostia::workstation {
namespace {

constexpr double minute_s = 60.0;

QString whole_number(double value) {
  return QString::fromStdString(core::fixed_text(value, 0));
}

QString ffr_cell(const hemodynamics::LesionReading& one, double value) {
  return one.occluded ? PressurePage::tr("occluded") : quantity::ratio(value);
}

void set_cells(QTreeWidgetItem& item, const QStringList& cells) {
  for (int c = 0; c < cells.size(); ++c) {
    item.setText(c, cells[c]);
    item.setToolTip(c, cells[c]);
    if (c > 1) item.setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
  }
}

void set_rows(QTreeWidget& tree, int rows) {
  while (tree.topLevelItemCount() > rows) delete tree.topLevelItem(tree.topLevelItemCount() - 1);
  while (tree.topLevelItemCount() < rows) new QTreeWidgetItem(&tree);
}

void mark_significant(QTreeWidgetItem& item, int column, bool significant) {
  QFont font = item.font(column);
  font.setBold(significant);
  item.setFont(column, font);
}

}  // namespace

void PressurePage::fill_lesions(const session::PressureReport& now) {
  const auto& lesions = now.under_hyperaemia.lesions;
  set_rows(*lesions_, static_cast<int>(lesions.size()));
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    const hemodynamics::LesionReading& one = lesions[i];
    const hemodynamics::Branch& branch = now.tree.network.branches[one.lesion.throat.branch];
    QTreeWidgetItem& item = *lesions_->topLevelItem(static_cast<int>(i));
    QString after;
    if (now.after) {
      const auto& other = now.after->under_hyperaemia.lesions[i];
      after = ffr_cell(other, other.behind);
    }
    set_cells(item, {QString::fromStdString(branch.name), quantity::length(one.lesion.throat.s_mm),
                     ffr_cell(one, one.behind), ffr_cell(one, one.delta()), after});
    mark_significant(item, 2, one.occluded || one.behind <= now.options.reading.threshold);
    item.setData(0, Qt::UserRole, branch.vessel);
    item.setData(1, Qt::UserRole, one.lesion.throat.s_mm);
  }
}

void PressurePage::fill_outlets(const session::PressureReport& now) {
  const auto& network = *now.network;
  const auto& outlets = network.outlets();
  using hemodynamics::outlet_ratio;
  set_rows(*outlets_, static_cast<int>(outlets.size()));
  for (std::size_t k = 0; k < outlets.size(); ++k) {
    const double most = now.hyperaemia.solution.flow_ml_s[outlets[k]],
                 rest = now.rest.solution.flow_ml_s[outlets[k]];
    const auto ffr = outlet_ratio(network, now.under_hyperaemia, k);
    QTreeWidgetItem& item = *outlets_->topLevelItem(static_cast<int>(k));
    set_cells(
        item,
        {QString::fromStdString(network.network().branches[outlets[k]].name), quantity::ratio(ffr),
         whole_number(most * minute_s),
         quantity::ratio(rest > 0.0 ? std::optional(most / rest) : std::nullopt),
         quantity::ratio(ffr ? std::optional(now.under_hyperaemia.pullbacks[k].ppg_index) : std::nullopt),
         now.after ? quantity::ratio(outlet_ratio(now.after->network, now.after->under_hyperaemia, k))
                   : QString()});
    mark_significant(item, 1, ffr && *ffr <= now.options.reading.threshold);
  }
}

void PressurePage::fill_stretches() {
  const session::PressureNotes notes = pressures_.board().notes();
  set_rows(*stretches_, static_cast<int>(notes.what_ifs.size()));
  for (std::size_t i = 0; i < notes.what_ifs.size(); ++i) {
    const session::WhatIf& one = notes.what_ifs[i];
    const QString percent = quantity::percent(one.percent);
    set_cells(*stretches_->topLevelItem(static_cast<int>(i)),
              {QString::fromStdString(desk_.bench.vessel_name(one.vessel)),
               quantity::length(one.from_mm) + QStringLiteral("\u2013") + quantity::length(one.to_mm),
               one.kind == session::WhatIfKind::open ? tr("open, %1 % left").arg(percent)
                                                     : tr("narrowed by %1 %").arg(percent)});
  }
}

}  // namespace ostia::workstation
