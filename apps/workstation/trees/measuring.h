#pragma once
/// \file What clicks into a vessel tree measure. No Qt: the panel shows it, the view draws it.

#include "ostia/analysis/tree_ruler.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::workstation {

enum class TreeTool { select, straight, along, angle, region };

/// One value that was measured, and where.
struct TreeMeasured {
  TreeTool tool = TreeTool::straight;
  double value = 0.0;
  std::string unit;                      ///< "mm", "deg"
  std::vector<std::int64_t> references;  ///< of the segments that were clicked, as the data file calls them
  std::vector<geometry::Vec3> points;    ///< that were clicked, in mm
  std::optional<analysis::SubtreeTotals> totals;  ///< of a region
};
/// For tables: "straight_distance".
std::string name_of(TreeTool tool);
/// A header and a line for each: kind, value, unit, references, points, totals of regions. RFC 4180.
std::string measured_csv(const std::vector<TreeMeasured>& measured);

/// Collects clicks until the tool has what it needs.
class TreeMeasuring {
 public:
  explicit TreeMeasuring(std::shared_ptr<const analysis::TreeRuler> ruler) : ruler_(std::move(ruler)) {}
  TreeTool tool() const { return tool_; }
  void choose(TreeTool tool);  ///< and forgets what was clicked for the one before
  double region_radius_mm = 1.0;
  /// The measured value where the click was the last one that was needed. Straight distances are between the
  /// places on the wall, those along the tree between the places on the axes. Throws InvalidInput where there
  /// is no value: two trees, no tree, a segment without a length.
  std::optional<TreeMeasured> click(const analysis::TreeRayHit& hit);
  const std::vector<analysis::TreeRayHit>& clicked() const { return clicked_; }
  const std::vector<TreeMeasured>& measured() const { return measured_; }
  void clear();

 private:
  TreeMeasured measure(const std::vector<analysis::TreeRayHit>& hits) const;
  std::shared_ptr<const analysis::TreeRuler> ruler_;
  TreeTool tool_ = TreeTool::select;
  std::vector<analysis::TreeRayHit> clicked_;
  std::vector<TreeMeasured> measured_;
};

}  // namespace ostia::workstation
