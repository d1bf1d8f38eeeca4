#pragma once
/// \file How an edit at one place of a tree spreads along its axes.

#include "editing/tree_editing.h"

#include <map>

namespace ostia::lumen {

/// The weight of a move: 1 at a place of the tree, falling smoothly to 0 at `reach_mm` from it along the
/// axes, into every branch on the way.
class AxisReach {
 public:
  /// `only`: the segments that it spreads into; empty for all.
  AxisReach(geometry::VesselTree tree, std::int32_t segment, double along_mm, double reach_mm,
            std::set<std::int32_t> only = {});
  bool passes(std::int32_t segment) const { return only_.empty() || only_.contains(segment); }
  double weight(std::int32_t segment, double along_mm) const;
  double weight_at_node(std::int32_t node) const;
  /// At an abscissa of a vessel's axis of this length.
  double weight(const geometry::Vessel& vessel, double axis_length_mm, double s_mm) const;
  const geometry::VesselTree& tree() const { return tree_; }

 private:
  geometry::VesselTree tree_;
  std::int32_t centre_;
  double along_, reach_;
  std::set<std::int32_t> only_;
  std::map<std::int32_t, double> node_distance_;
  double falloff(double distance) const;
};

/// Puts points on a segment's smooth axis where neighbours are farther apart than `gap_mm`.
void make_dense(TreeEdit& edit, std::int32_t segment, double gap_mm);

/// Moves all points of the tree by `shift` times their weight.
void move_axes(TreeEdit& edit, const AxisReach& reach, const Vec3& shift);

/// Samples that went with their axis: displaced with its place and turned as its tangent turned.
std::vector<SurfaceSample> moved_samples(const VesselLumen& before, const VesselLumen& after,
                                         const std::function<double(double)>& weight, const Vec3& shift,
                                         const AbscissaMap& map);

}  // namespace ostia::lumen
