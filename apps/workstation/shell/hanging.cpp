#include "shell/hanging.h"

#include "shell/panel.h"

#include <QEvent>
#include <QScreen>
#include <QSplitter>
#include <QTabWidget>
#include <algorithm>

namespace ostia::workstation {
namespace {

enum ColumnState { side_column, curved_column, section_column, tree_column, columns };
constexpr int comfort = 100;          // units of the interface that the CPRs get beyond their least
constexpr int lists_comfort = 24;     // that the lists get: a scroll bar beside their columns
constexpr double curved_share = 0.6;  // of what CPRs and sections share

int least_width(const QWidget& widget) {
  return std::max(widget.minimumWidth(), widget.minimumSizeHint().width());
}

}  // namespace

void resize_within(QWidget& dialog, const QSize& wanted) {
  QSize size = wanted.boundedTo(dialog.screen()->availableSize());
  if (const QWidget* parent = dialog.parentWidget()) size = size.boundedTo(parent->window()->size());
  dialog.resize(size);
}

Hanging::Hanging(QSplitter* columns, QTabWidget* tabs, Panel* tree)
    : QObject(columns), columns_(columns), tabs_(tabs), tree_(tree) {
  columns->installEventFilter(this);
  // The columns themselves ask for no more than what cannot be done without: else a window could never
  // become so narrow that the others go.
  columns->setMinimumWidth(needed(curved_column, section_column));
}

int Hanging::needed(int first, int last) const {
  int width = (last - first) * columns_->handleWidth();
  for (int i = first; i <= std::min(last, columns_->count() - 1); ++i)
    width += least_width(*columns_->widget(i));
  if (last == tree_column && narrow_ && tree_kept_ && !tree_away_) width += least_width(*tree_);
  if (last == tree_column && !narrow_ && !tree_kept_ && columns_->count() > tree_column)
    width -= least_width(*tree_);
  return width;
}

void Hanging::rest(bool resting) {
  resting_ = resting;
  if (!resting) fit();
}

void Hanging::keep_tree(bool kept) {
  tree_kept_ = kept;
  if (tree_away_) {
    // It is hidden and shown by whoever has it.
  } else if (narrow_) {
    const int at = tabs_->indexOf(tree_);
    if (!kept && at >= 0) tabs_->removeTab(at);
    if (kept && at < 0) tabs_->setTabToolTip(tabs_->addTab(tree_, tr("Tree")), tree_->accessibleName());
    if (!kept) tree_->hide();
  } else {
    tree_->setVisible(kept);
  }
  fit();
}

void Hanging::lend_tree(bool away) {
  if (away == tree_away_) return;
  if (away && narrow_) tabs_->removeTab(tabs_->indexOf(tree_));
  if (away && !narrow_) wide_sizes_ = columns_->saveState();
  tree_away_ = away;
  if (away) return;
  if (narrow_) return keep_tree(tree_kept_);
  columns_->insertWidget(tree_column, tree_);
  tree_->setVisible(tree_kept_);
  columns_->restoreState(wide_sizes_);
}

QByteArray Hanging::sizes() const {
  return narrow_ || tree_away_ ? wide_sizes_ : columns_->saveState();
}

void Hanging::fit() {
  if (resting_) return;
  QWidget* side = columns_->widget(side_column);
  const int room = columns_->width();
  const bool narrow = room < needed(side_column, tree_column) + comfort;
  if (narrow != narrow_) set_narrow(narrow);
  const bool lists =
      has_views(*side) && (!narrow || room >= needed(side_column, section_column) + comfort / 2);
  if (side->isHidden() != lists) return;
  side->setVisible(lists);
  if (narrow) share_room();
}

void Hanging::set_narrow(bool narrow) {
  if (tree_away_) {
    narrow_ = narrow;
    if (narrow) share_room();
  } else if (narrow) {
    wide_sizes_ = columns_->saveState();
    if (tree_kept_) tabs_->setTabToolTip(tabs_->addTab(tree_, tr("Tree")), tree_->accessibleName());
    narrow_ = true;
    share_room();
  } else {
    columns_->insertWidget(tree_column, tree_);
    tree_->setVisible(tree_kept_);
    narrow_ = false;
    columns_->widget(side_column)->show();
    columns_->restoreState(wide_sizes_);
  }
  emit narrow_changed(narrow);
}

void Hanging::share_room() {
  const QWidget* side = columns_->widget(side_column);
  const int lists = side->isHidden() ? 0 : least_width(*side) + lists_comfort;
  const int rest = std::max(2, columns_->width() - lists - 2 * columns_->handleWidth());
  const int curved = static_cast<int>(curved_share * rest);
  columns_->setSizes({lists, curved, rest - curved});
}

bool Hanging::eventFilter(QObject* object, QEvent* event) {
  if (object == columns_ && event->type() == QEvent::Resize) fit();
  return QObject::eventFilter(object, event);
}

}  // namespace ostia::workstation
