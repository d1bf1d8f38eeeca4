#pragma once
/// \file A vessel tree with its facts and measuring tools, in the place of the case's views.

#include "shell/over_views.h"
#include "trees/measuring.h"
#include "trees/view.h"

#include <string>

class QDoubleSpinBox;
class QLabel;
class QMainWindow;
class QTableWidget;

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// What the page shows, made in the background.
struct OpenTree {
  std::shared_ptr<const geometry::VesselGraph> graph;
  std::shared_ptr<const analysis::TreeRuler> ruler;
  std::shared_ptr<const analysis::TreeRays> rays;
  std::shared_ptr<const geometry::SegmentBlocks> blocks;
  std::string name;            ///< of the file
  std::string reference_name;  ///< what its references are: "line", "cell"
  std::string notes;           ///< faults that are left, what was repaired
};

class TreePage final : public OverViews {
  Q_OBJECT
 public:
  /// Lies over the window's views, which come back when it goes.
  TreePage(Desk& desk, QMainWindow& window, const CommandTable& commands, OpenTree tree);
  ~TreePage() override;
  void choose(TreeTool tool);
  void show_grid(bool shown);
  void show_subtree(bool only);  ///< of the segment that is chosen
  void fit();
  void copy() const;
  void export_csv();
  void clear();
  const TreeMeasuring& measuring() const { return measuring_; }
  std::int32_t chosen() const { return chosen_; }
  TreeView& view() { return *view_; }

 private:
  QWidget* build_panel();
  void click(const QPointF& at);
  void choose_segment(std::int32_t edge);
  void show_facts();
  void show_measured();
  void show_marks();
  QString text_of(const TreeMeasured& one) const;
  Desk& desk_;
  const CommandTable& commands_;
  OpenTree tree_;
  TreeMeasuring measuring_;
  std::int32_t chosen_ = -1;
  TreeView* view_ = nullptr;
  QLabel* facts_ = nullptr;
  QTableWidget* table_ = nullptr;
  QDoubleSpinBox* radius_ = nullptr;
};

}  // namespace ostia::workstation
