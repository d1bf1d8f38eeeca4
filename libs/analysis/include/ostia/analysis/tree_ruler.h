#pragma once
/// \file What a person asks of a tree with a mouse in the hand: facts of a segment, distances along it,
/// angles, what lies in a sphere, and what is under a ray. See docs/methods/tree-measures.md, "Asking one
/// tree many times".

#include "ostia/analysis/graph_report.h"

#include <array>
#include <memory>
#include <span>

namespace ostia::analysis {

/// A place on a segment's axis: `t` is 0 at its proximal and 1 at its distal end.
struct TreePlace {
  std::int32_t edge = -1;
  double t = 0.0;
};

struct SegmentFacts {
  std::int64_t reference = 0;  ///< what the data file calls it
  ConeMeasure cone;
  double radius_from_mm = 0.0, radius_to_mm = 0.0;
  bool of_tree = false;  ///< false: the network is no tree, and what follows is not known
  std::int32_t strahler = 0, diameter_order = 0;
  std::int32_t branch = -1;   ///< into TreeReport::branches
  double from_root_mm = 0.0;  ///< along the tree to the proximal end
  SubtreeTotals behind;       ///< with the segment itself
};

/// Measured once, in time and memory in proportion to the tree; then each question takes no time that a
/// person could see: facts and angles a look-up, a distance the number of segments on the way, a sphere or a
/// subtree one pass. Safe to ask from several threads.
class TreeRuler {
 public:
  /// A network that is no tree, or has no finite places and radii, is taken too: then `why_no_tree` tells why
  /// and what needs a tree has no value. Throws InvalidInput for indices out of range, and Cancelled.
  explicit TreeRuler(std::shared_ptr<const geometry::VesselGraph> graph,
                     const core::TaskContext& task = core::no_task());

  const geometry::VesselGraph& graph() const { return *graph_; }
  const std::string& why_no_tree() const { return why_no_tree_; }  ///< empty: it is one, or several
  const TreeReport* report() const { return report_ ? &*report_ : nullptr; }

  SegmentFacts facts(std::int32_t edge) const;
  geometry::Vec3 point(const TreePlace& place) const;
  double radius_mm(const TreePlace& place) const;
  double straight_mm(const TreePlace& a, const TreePlace& b) const;
  /// None: of two trees, or no tree.
  std::optional<double> along_mm(const TreePlace& a, const TreePlace& b) const;
  /// Between the proximal-to-distal directions of two segments, 0 to pi; none where one has no length.
  std::optional<double> angle_rad(std::int32_t a, std::int32_t b) const;
  /// At the fork where the segment ends or, with nothing but one segment behind it, where its branch does.
  /// Null: it forks nowhere, or no tree.
  const ForkAngles* fork_behind(std::int32_t edge) const;
  /// 1 for the segment and all behind it, else 0; one for each segment. All 0 where there is no tree.
  std::vector<std::uint8_t> subtree(std::int32_t edge) const;
  /// What lies in a sphere; segments that its surface cuts count with the part that is inside, and as one
  /// segment each. `ends` are distal ends of the tree inside. Radius >= 0, else InvalidInput.
  SubtreeTotals within(const geometry::Vec3& centre, double radius_mm) const;

 private:
  double length_mm(std::int32_t edge) const;
  std::shared_ptr<const geometry::VesselGraph> graph_;
  std::string why_no_tree_;
  std::optional<TreeReport> report_;
  std::optional<TreeDistances> distances_;
  std::vector<std::uint8_t> ends_;  ///< 1 where no segment leaves the point
};

/// From an eye into the tree.
struct TreeRay {
  geometry::Vec3 origin, direction;  ///< any length above 0
  /// What passes a segment's wall by less than this for each mm from the eye hits it, so that a vessel
  /// thinner than a pixel can be taken.
  double slack = 0.0;
};
struct TreeRayHit {
  TreePlace place;  ///< on the axis: the ball about it is the first of the segment's that the ray enters
  geometry::Vec3 surface;  ///< on the ray, where it does; beside a thin vessel, the place nearest to its axis
  double depth_mm = 0.0;   ///< of `surface`, from the ray's origin
};

/// A hierarchy of boxes over the segments that have finite places; radii that are no positive number count as
/// 0. Built once in O(n log n); a ray visits the boxes it meets.
class TreeRays {
 public:
  explicit TreeRays(std::shared_ptr<const geometry::VesselGraph> graph,
                    const core::TaskContext& task = core::no_task());
  /// The segment that the ray enters first; `shown`, where it is not empty, has 0 for those to look through.
  std::optional<TreeRayHit> first(const TreeRay& ray, std::span<const std::uint8_t> shown = {}) const;

 private:
  struct Node {
    std::array<float, 3> lower, upper;
    std::int32_t next = 0;   ///< inner node: its right child, the left one follows; leaf: first in `order_`
    std::int32_t count = 0;  ///< 0: an inner node
  };
  void build(const core::TaskContext& task);
  Node node_of(std::int32_t first, std::int32_t last) const;
  std::shared_ptr<const geometry::VesselGraph> graph_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

/// Lines of a grid and how they are labelled.
struct GridScale {
  double step_mm = 1.0;  ///< 1, 2 or 5 times a power of ten
  std::string unit;      ///< "um" below 0.1 mm, "cm" from 10 mm on, else "mm"
  double per_mm = 1.0;   ///< of the unit
};
/// The widest step that still puts at least `least_lines` - 1 steps into `size_mm`. Throws InvalidInput
/// unless size_mm > 0 and finite and least_lines >= 2.
GridScale grid_scale(double size_mm, int least_lines = 5);
/// Multiples of the step from `low` to `high`, both included; 0 is 0 exactly. At most 10 000, else
/// InvalidInput.
std::vector<double> grid_ticks(double low, double high, double step_mm);
/// "2.5 mm": with as many decimals as the step needs, in the scale's unit.
std::string tick_text(double value_mm, const GridScale& scale);

}  // namespace ostia::analysis
