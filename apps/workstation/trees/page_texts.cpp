// What the page of a vessel tree says of a segment and of what was measured.

#include "shell/library_texts.h"
#include "trees/page.h"

#include <QLabel>
#include <QStringList>
#include <numbers>

namespace ostia::workstation {
namespace {

QString tree_number(double value) {
  return QString::number(value, 'g', 6);
}

QString degrees(double radians) {
  return QString::number(radians * 180.0 / std::numbers::pi, 'f', 1);
}

}  // namespace

QString TreePage::text_of(const TreeMeasured& one) const {
  if (one.tool == TreeTool::angle) return tr("%1 degrees").arg(QString::number(one.value, 'f', 2));
  if (!one.totals) return tr("%1 mm").arg(tree_number(one.value));
  return tr("%n segment(s), %1 mm, %2 mm\u00b2, %3 mm\u00b3", nullptr, one.totals->segments)
      .arg(tree_number(one.totals->length_mm), tree_number(one.totals->area_mm2),
           tree_number(one.totals->volume_mm3));
}

void TreePage::show_facts() {
  QStringList lines{QString::fromStdString(tree_.name),
                    tr("%n segment(s)", nullptr, static_cast<int>(tree_.graph->edges.size()))};
  if (!tree_.notes.empty()) lines << library_text(tree_.notes);
  if (chosen_ < 0) {
    lines << QString() << tr("Click a segment to see its facts.");
    facts_->setText(lines.join('\n'));
    return;
  }
  const analysis::SegmentFacts facts = tree_.ruler->facts(chosen_);
  lines << QString() << QString::fromStdString(tree_.reference_name) + ' ' + QString::number(facts.reference)
        << tr("Length %1 mm").arg(tree_number(facts.cone.length_mm))
        << tr("Radius %1 to %2 mm").arg(tree_number(facts.radius_from_mm), tree_number(facts.radius_to_mm))
        << tr("Lateral area %1 mm\u00b2").arg(tree_number(facts.cone.area_mm2))
        << tr("Volume %1 mm\u00b3").arg(tree_number(facts.cone.volume_mm3));
  if (facts.of_tree) {
    lines << tr("Strahler order %1, by diameter %2").arg(facts.strahler).arg(facts.diameter_order)
          << tr("From the root %1 mm").arg(tree_number(facts.from_root_mm))
          << tr("With all behind it: %n segment(s),", nullptr, facts.behind.segments) + ' ' +
                 tr("%1 mm, %2 mm\u00b2, %3 mm\u00b3")
                     .arg(tree_number(facts.behind.length_mm), tree_number(facts.behind.area_mm2),
                          tree_number(facts.behind.volume_mm3));
    if (const analysis::ForkAngles* fork = tree_.ruler->fork_behind(chosen_))
      lines << tr("At its fork %1\u00b0 between the two, %2\u00b0 and %3\u00b0 from the parent")
                   .arg(degrees(fork->between_rad), degrees(fork->wide_rad), degrees(fork->narrow_rad));
  } else {
    lines << tr("Orders and what lies behind it are known of trees alone.");
  }
  facts_->setText(lines.join('\n'));
}

}  // namespace ostia::workstation
