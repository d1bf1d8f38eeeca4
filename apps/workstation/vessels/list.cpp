#include "vessels/list.h"

#include "shell/list_rows.h"
#include "shell/quantities.h"
#include "vessels/connect_menu.h"
#include "vessels/tips.h"

#include "ostia/core/parallel.h"
#include "ostia/session/evaluability_board.h"
#include "ostia/view/evaluability_layer.h"

#include <QColorDialog>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QScopedValueRollback>
#include <QStyle>
#include <QTimer>
#include <algorithm>
#include <exception>

namespace ostia::workstation {
namespace {

enum VesselColumn {
  name_column,
  length_column,
  edited_column,
  stenosis_column,
  image_column,
  checked_column,
  vessel_columns
};
constexpr int vessel_id_role = Qt::UserRole;
constexpr int refresh_after_ms = 120;         // of an edit
constexpr int from_role = Qt::UserRole + 1;   // of a segment: its first abscissa
constexpr int color_role = Qt::UserRole + 2;  // of the icon
constexpr int name_characters = 10;           // at least to be read

QIcon color_icon(const QColor& color) {
  QPixmap pixmap(12, 12);
  pixmap.fill(color);
  return QIcon(pixmap);
}

int edited_samples(const lumen::VesselLumen& vessel) {
  return static_cast<int>(std::count_if(vessel.samples.begin(), vessel.samples.end(), [](const auto& sample) {
    return sample.origin == lumen::SampleOrigin::edit;
  }));
}

}  // namespace

VesselList::VesselList(session::Workbench& bench, std::function<QColor(std::int32_t)> color_of, Guard guard,
                       QWidget* parent)
    : QTreeWidget(parent),
      bench_(bench),
      color_of_(std::move(color_of)),
      turns_(bench),
      guard_(std::move(guard)) {
  setObjectName("vessels");
  setAccessibleName(tr("Vessels"));
  setColumnCount(vessel_columns);
  setHeaderLabels({tr("Vessel"), tr("mm"), tr("Edits"), tr("Worst"), tr("Image"), tr("Done")});
  headerItem()->setToolTip(edited_column, tr("Samples of the wall that a person placed"));
  headerItem()->setToolTip(stenosis_column, tr("Largest narrowing, percent of diameter"));
  headerItem()->setToolTip(image_column,
                           tr("How far the image shows the vessel: a dot where nothing keeps it from being "
                              "judged, else where it can be judged in part, or not at all"));
  headerItem()->setToolTip(checked_column, tr("A person has gone through this vessel"));
  setUniformRowHeights(true);
  setEditTriggers(EditKeyPressed | SelectedClicked);
  setIndentation(14);
  header()->setMinimumSectionSize(24);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(name_column, QHeaderView::Stretch);
  own_.push_back(bench.case_changed.observe([this] {
    {
      const QScopedValueRollback<bool> writing(writing_, true);
      clear();  // a name that is being typed is not for another case's vessel
    }
    fill();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (event.tree_changed) return fill();
    unmeasured_.insert(unmeasured_.end(), failed_.begin(), failed_.end());
    failed_.clear();
    turns_.begin();
    soon_.start(refresh_after_ms);
    measure_next();
  }));
  own_.push_back(bench.annotations_changed.observe([this] { refresh(); }));
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) { refresh(); }));
  soon_.setSingleShot(true);
  connect(&soon_, &QTimer::timeout, this, [this] {
    // Other vessels' narrowings can wait until the hand lets go.
    if (QGuiApplication::mouseButtons() != Qt::NoButton)
      soon_.start(refresh_after_ms);
    else if (turns_.next())
      soon_.start(0);
    else
      refresh();
  });
  measurer_.setMaxThreadCount(1);
  connect(this, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (!item || writing_) return;
    bench_.vessel.set(item->data(0, vessel_id_role).toInt());
    if (item->parent()) bench_.cursor_mm.set(bench_.here_mm(item->data(0, from_role).toDouble()));
  });
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (!writing_ && !item->parent()) edited(item, column);
  });
}

/// Items that are there are kept: what is unfolded, or being renamed, stays so.
void VesselList::fill() {
  unmeasured_.clear();
  failed_.clear();
  const lumen::LumenModel* model = bench_.model();
  {
    const QScopedValueRollback<bool> writing(writing_, true);
    int rows = 0;
    if (model) {
      const std::vector<analysis::VesselSegment> segments = analysis::segments_of(*model);
      for (const std::int32_t vessel : analysis::vessels_in_reading_order(model->tree)) {
        unmeasured_.push_back(vessel);
        show_segments(row_of(*this, vessel, rows++), segments);
      }
    }
    while (topLevelItemCount() > rows) delete topLevelItem(topLevelItemCount() - 1);
  }
  viewport()->update();  // an emptied tree leaves rows on the screen else
  if (!model) return;
  refresh();
  measure_next();
}

QTreeWidgetItem* VesselList::item_of(std::int32_t vessel) const {
  for (int i = 0; i < topLevelItemCount(); ++i)
    if (topLevelItem(i)->data(0, vessel_id_role).toInt() == vessel) return topLevelItem(i);
  return nullptr;
}

void VesselList::show_segments(QTreeWidgetItem& item, const std::vector<analysis::VesselSegment>& segments) {
  const std::int32_t vessel = item.data(0, vessel_id_role).toInt();
  int parts = 0;
  for (const analysis::VesselSegment& segment : segments) {
    if (segment.vessel != vessel || !segment.aha) continue;
    QTreeWidgetItem* part = parts < item.childCount() ? item.child(parts) : new QTreeWidgetItem(&item);
    ++parts;
    part->setData(0, vessel_id_role, vessel);
    part->setData(0, from_role, segment.from_mm);
    part->setText(name_column, QString::fromStdString(segment.label));
    part->setText(length_column, quantity::length(segment.to_mm - segment.from_mm));
    part->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  }
  while (item.childCount() > parts) delete item.child(item.childCount() - 1);
}

/// One vessel after the other, beside the window. What the window itself has measured meanwhile is left out;
/// where the model is another when the work is done, it is done again.
void VesselList::measure_next() {
  while (!unmeasured_.empty() && !measuring_) {
    std::optional<session::ProfileWork> work = bench_.profile_work(unmeasured_.front());
    if (!work) {
      unmeasured_.erase(unmeasured_.begin());
      soon_.start(refresh_after_ms);
      continue;
    }
    measuring_ = true;
    measurer_.start([this, work = std::move(*work), task = measuring_task_] {
      core::lower_thread_priority();
      std::shared_ptr<const analysis::LumenProfile> profile;
      try {
        profile = std::make_shared<const analysis::LumenProfile>(work.measured(task));
      } catch (const std::exception&) {  // told where the profile is looked at
      }
      QMetaObject::invokeMethod(
          this, [this, work, profile] { take(work, profile); }, Qt::QueuedConnection);
    });
  }
}

void VesselList::take(const session::ProfileWork& work,
                      const std::shared_ptr<const analysis::LumenProfile>& profile) {
  measuring_ = false;
  const bool still = !unmeasured_.empty() && unmeasured_.front() == work.vessel && bench_.has_case() &&
                     bench_.session().file().model() == work.model;
  if (still && (!profile || bench_.take_profile(work, *profile))) {
    unmeasured_.erase(unmeasured_.begin());
    if (!profile) failed_.push_back(work.vessel);
    soon_.start(refresh_after_ms);
  }
  measure_next();
}

VesselList::~VesselList() {
  measuring_task_.cancel();
  measurer_.waitForDone();
}

session::VesselMark VesselList::mark_of(std::int32_t vessel) const {
  return session::mark_or_new(*bench_.session().file().annotations(), vessel);
}

/// The board may go before the list does.
void VesselList::show_evaluability(session::EvaluabilityBoard& board) {
  own_.push_back(board.changed.observe([this, &board] {
    const QScopedValueRollback<bool> writing(writing_, true);
    for (int i = 0; i < topLevelItemCount(); ++i)
      show_grade(*topLevelItem(i), board.stretches(topLevelItem(i)->data(0, vessel_id_role).toInt()));
    share_width();
  }));
}

/// The worst grade that more than a tenth of the vessel has; which stretches, in the tip.
void VesselList::show_grade(QTreeWidgetItem& item, const std::vector<analysis::EvaluableStretch>& stretches) {
  using analysis::Evaluability;
  QString text, tip;
  const double no = analysis::share_of(stretches, Evaluability::not_evaluable),
               some = no + analysis::share_of(stretches, Evaluability::limited);
  if (!stretches.empty()) text = QStringLiteral("\u2022");
  if (some > 0.1) text = tr("in part");
  if (no > 0.1) text = tr("%1 % not").arg(quantity::percent(100.0 * no));
  for (const analysis::EvaluableStretch& one : stretches)
    if (one.grade != Evaluability::evaluable || one.by_person)
      tip += tr("%1 to %2 mm: %3")
                 .arg(quantity::length(one.from_mm), quantity::length(one.to_mm),
                      QString::fromStdString(view::text_of(one))) +
             '\n';
  if (!stretches.empty() && tip.isEmpty()) tip = tr("All of it can be judged");
  item.setText(image_column, text);
  item.setToolTip(image_column, tip.trimmed());
}

void VesselList::refresh() {
  if (!bench_.model()) return;
  const QScopedValueRollback<bool> writing(writing_, true);
  for (int i = 0; i < topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = topLevelItem(i);
    const std::int32_t id = item->data(0, vessel_id_role).toInt();
    if (!bench_.axis(id)) continue;  // deleted just now; the list is filled anew next
    show_vessel(*item, id);
    show_narrowing(*item, id);
    if (id == bench_.vessel.get() && state() != EditingState &&
        (!currentItem() || currentItem()->data(0, vessel_id_role).toInt() != id))
      setCurrentItem(item);
  }
  share_width();
}

void VesselList::show_vessel(QTreeWidgetItem& item, std::int32_t id) {
  const lumen::VesselLumen& vessel = lumen::vessel(*bench_.model(), id);
  const session::VesselMark mark = mark_of(id);
  const QString name = QString::fromStdString(bench_.vessel_name(id));
  // Whatever changes in the column takes away what is being typed there.
  if (state() != EditingState || currentItem() != &item) {
    item.setText(name_column, name);
    const QColor color = color_of_(id);
    if (item.data(name_column, color_role).value<QColor>() != color) {
      item.setData(name_column, color_role, color);
      item.setIcon(name_column, color_icon(color));
    }
    item.setCheckState(name_column, mark.visible ? Qt::Checked : Qt::Unchecked);
    item.setToolTip(name_column, name + '\n' + tr("Tick: shown in 3D. F2: another name."));
  }
  item.setText(length_column, quantity::length(vessel.axis->length()));
  const int edits = edited_samples(vessel);
  item.setText(edited_column, edits > 0 ? QString::number(edits) : QStringLiteral("\u2013"));
  item.setCheckState(checked_column, mark.checked ? Qt::Checked : Qt::Unchecked);
  const bool doubtful = !mark.note.empty() && !mark.checked;
  item.setText(checked_column, doubtful ? QStringLiteral("?") : QString());
  item.setToolTip(checked_column, QString::fromStdString(mark.note));
}

void VesselList::show_narrowing(QTreeWidgetItem& item, std::int32_t id) {
  const auto among = [id](const std::vector<std::int32_t>& ids) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  if (among(failed_)) {
    item.setText(stenosis_column, QStringLiteral("?"));
  } else if (!among(unmeasured_)) {
    // On the way that it shares, a narrowing is the other vessel's.
    const double own = lumen::own_from_mm(bench_.model()->tree, id);
    double worst = 0.0;
    for (const analysis::Stenosis& one : bench_.stenoses(id))
      if (one.throat_mm >= own) worst = std::max(worst, one.diameter_percent);
    item.setText(stenosis_column, worst > 0.0 ? quantity::stenosis(worst) + " %" : QStringLiteral("\u2013"));
  }
}

/// The name is to be read: where there is little room, the edits go first, and then the list scrolls.
void VesselList::share_width() {
  QFont bold = header()->font();
  bold.setBold(true);
  const int margins = 4 * style()->pixelMetric(QStyle::PM_HeaderMargin, nullptr, header());
  const auto wanted = [&](int column) {
    const int title = QFontMetrics(bold).horizontalAdvance(headerItem()->text(column)) + margins;
    return std::max({title, sizeHintForColumn(column), header()->minimumSectionSize()});
  };
  const int least = indentation() + style()->pixelMetric(QStyle::PM_SmallIconSize) +
                    style()->pixelMetric(QStyle::PM_IndicatorWidth) +
                    (name_characters + 2) * fontMetrics().averageCharWidth();
  const int others =
      wanted(length_column) + wanted(stenosis_column) + wanted(image_column) + wanted(checked_column);
  const int room = viewport()->width();
  const int names = std::min(least, wanted(name_column));
  setColumnHidden(edited_column, others + wanted(edited_column) + names > room);
  const bool scrolls = others + names > room;
  header()->setSectionResizeMode(name_column, scrolls ? QHeaderView::Fixed : QHeaderView::Stretch);
  if (scrolls) header()->resizeSection(name_column, names);
}

void VesselList::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  share_width();
}

/// What was not written while the name was typed.
void VesselList::closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) {
  QTreeWidget::closeEditor(editor, hint);
  soon_.start(refresh_after_ms);
}

void VesselList::edited(QTreeWidgetItem* item, int column) {
  const std::int32_t id = item->data(0, vessel_id_role).toInt();
  session::VesselMark mark = mark_of(id);
  const bool visible = item->checkState(name_column) == Qt::Checked;
  const bool checked = item->checkState(checked_column) == Qt::Checked;
  const std::string name = item->text(name_column).trimmed().toStdString();
  guard_([&] {
    if (column == name_column && name != bench_.vessel_name(id)) {
      bench_.edit(lumen::VesselRename{id, name});
    } else if (mark.visible != visible || mark.checked != checked) {
      mark.visible = visible;
      mark.checked = checked;
      bench_.annotate(session::MarkVessel{mark});
    }
  });
  refresh();  // what was refused is shown as it is
}

void VesselList::choose_color(std::int32_t vessel) {
  const QColor chosen = QColorDialog::getColor(
      color_of_(vessel), this, tr("Colour of %1").arg(QString::fromStdString(bench_.vessel_name(vessel))));
  if (!chosen.isValid()) return;
  guard_([&] {
    session::VesselMark mark = mark_of(vessel);
    mark.color = {{chosen.redF(), chosen.greenF(), chosen.blueF()}};
    bench_.annotate(session::MarkVessel{mark});
  });
}

void VesselList::delete_vessel(std::int32_t vessel) {
  guard_([&] {
    const geometry::VesselTree& tree = bench_.model()->tree;
    const bool all = std::all_of(tree.vessels.begin(), tree.vessels.end(), [&](const geometry::Vessel& one) {
      return lumen::leads_through(tree, one.id, vessel);
    });
    if (!all) {
      bench_.edit(lumen::BranchDelete{vessel});
      return;
    }
    bench_.require_own_phase();
    emit last_deleted();
  });
}

void VesselList::contextMenuEvent(QContextMenuEvent* event) {
  QTreeWidgetItem* item = currentItem();
  if (!item) return;
  if (item->parent()) item = item->parent();
  const std::int32_t id = item->data(0, vessel_id_role).toInt();
  QMenu menu(this);
  menu.setToolTipsVisible(true);
  // The list may be another while the menu is open.
  menu.addAction(tr("Rename\u2026"), this, [this, id] {
    if (QTreeWidgetItem* named = item_of(id)) editItem(named, name_column);
  });
  menu.addAction(tr("Colour\u2026"), this, [this, id] { choose_color(id); });
  menu.addSeparator();
  menu.addAction(tr("Cut off distal of the cursor"), this, [this, id] {
    guard_([&] { bench_.edit(lumen::AxisTrim{id, bench_.cursor_mm.get()}); });
  });
  QAction* split = menu.addAction(tr("Split at the cursor"), this, [this, id] {
    guard_([&] { bench_.edit(lumen::BranchSplit{id, bench_.cursor_mm.get(), {}}); });
  });
  split->setToolTip(vessel_tips::split());
  const auto parent = lumen::merge_parent(bench_.model()->tree, id);
  QAction* merge = menu.addAction(tr("Join with parent vessel"), this, [this, id, parent] {
    guard_([&] {
      const double cursor = bench_.cursor_mm.get();
      bench_.edit(lumen::BranchMerge{id});
      bench_.vessel.set(*parent);  // the same place: its abscissas go on as they were
      bench_.cursor_mm.set(cursor);
    });
  });
  merge->setToolTip(vessel_tips::merge());
  merge->setEnabled(parent.has_value());
  QAction* cut = menu.addAction(tr("Cut in two at the cursor"), this, [this, id] {
    guard_([&] { bench_.edit(lumen::BranchCut{id, bench_.cursor_mm.get(), {}}); });
  });
  cut->setToolTip(vessel_tips::cut());
  QMenu* connect = connect_menu(bench_, guard_, &menu);
  connect->setTitle(tr("Connect to the cursor"));
  menu.addMenu(connect)->setToolTip(vessel_tips::connect());
  menu.addAction(tr("Delete with its branches"), this, [this, id] { delete_vessel(id); });
  auto* joints = menu.addMenu(tr("Join to"));
  joints->setToolTip(tr("Where its own part begins goes to the nearest place of that vessel"));
  for (const geometry::Vessel& other : bench_.model()->tree.vessels) {
    if (other.id == id) continue;
    joints->addAction(QString::fromStdString(other.name), this, [this, id, parent = other.id] {
      guard_([&] {
        const auto axis = bench_.axis(id);
        if (!axis) return;  // gone while the menu was open
        bench_.edit(
            lumen::BranchAttach{id, parent, axis->point(lumen::own_from_mm(bench_.model()->tree, id))});
      });
    });
  }
  menu.exec(event->globalPos());
}

void VesselList::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete && currentItem()) {
    const std::int32_t id = currentItem()->data(0, vessel_id_role).toInt();
    delete_vessel(id);
    return;
  }
  QTreeWidget::keyPressEvent(event);
}

}  // namespace ostia::workstation
