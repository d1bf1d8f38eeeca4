#pragma once
/// \file The vessels of the case: names, colours, what is shown, what is checked.

#include "vessels/measuring_turns.h"
#include "views/picture_widget.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/session/workbench.h"

#include <QThreadPool>
#include <QTimer>
#include <QTreeWidget>
#include <vector>

namespace ostia::session {
class EvaluabilityBoard;
}

namespace ostia::workstation {

class VesselList final : public QTreeWidget {
  Q_OBJECT
 public:
  /// `color_of`: the colour that the 3D scene gives a vessel.
  VesselList(session::Workbench& bench, std::function<QColor(std::int32_t)> color_of, Guard guard,
             QWidget* parent = nullptr);
  ~VesselList() override;
  /// Tells of each vessel how far it can be judged.
  void show_evaluability(session::EvaluabilityBoard& board);

 signals:
  void last_deleted();  ///< the case's only vessel, with its branches, is to go

 public slots:
  void refresh();

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 protected slots:
  void closeEditor(QWidget* editor, QAbstractItemDelegate::EndEditHint hint) override;

 private:
  void fill();
  QTreeWidgetItem* item_of(std::int32_t vessel) const;
  void show_segments(QTreeWidgetItem& item, const std::vector<analysis::VesselSegment>& segments);
  void show_vessel(QTreeWidgetItem& item, std::int32_t vessel);
  void show_narrowing(QTreeWidgetItem& item, std::int32_t vessel);
  void show_grade(QTreeWidgetItem& item, const std::vector<analysis::EvaluableStretch>& stretches);
  void share_width();
  void measure_next();
  void take(const session::ProfileWork& work, const std::shared_ptr<const analysis::LumenProfile>& profile);
  void edited(QTreeWidgetItem* item, int column);
  session::VesselMark mark_of(std::int32_t vessel) const;
  void choose_color(std::int32_t vessel);
  void delete_vessel(std::int32_t vessel);
  session::Workbench& bench_;
  std::function<QColor(std::int32_t)> color_of_;
  QTimer soon_;
  MeasuringTurns turns_;
  std::vector<std::int32_t> unmeasured_;  // whose narrowings are still to be found, one at a time
  std::vector<std::int32_t> failed_;      // that could not be measured beside the window
  bool measuring_ = false;
  bool writing_ = false;  // the list itself, not a person
  core::TaskContext measuring_task_;
  QThreadPool measurer_;
  Guard guard_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
