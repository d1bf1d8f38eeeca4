#include "editing/axis_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::lumen {

AxisReach::AxisReach(geometry::VesselTree tree, std::int32_t segment, double along_mm, double reach_mm,
                     std::set<std::int32_t> only)
    : tree_(std::move(tree)), centre_(segment), along_(along_mm), reach_(reach_mm), only_(std::move(only)) {
  const geometry::TreeSegment& centre = geometry::segment(tree_, segment);
  node_distance_[centre.from] = along_;
  node_distance_[centre.to] = centre.axis.abscissa.back() - along_;
  for (bool grown = true; grown;) {  // there is one way between two nodes of a tree
    grown = false;
    for (const geometry::TreeSegment& s : tree_.segments) {
      const bool from = node_distance_.contains(s.from), to = node_distance_.contains(s.to);
      if (from == to || !passes(s.id)) continue;
      const double length = s.axis.abscissa.back();
      node_distance_[from ? s.to : s.from] = node_distance_.at(from ? s.from : s.to) + length;
      grown = true;
    }
  }
}

double AxisReach::falloff(double distance) const {
  const double u = distance / reach_;
  return u >= 1.0 ? 0.0 : (1.0 - u * u) * (1.0 - u * u);
}

double AxisReach::weight_at_node(std::int32_t node) const {
  const auto found = node_distance_.find(node);
  return found == node_distance_.end() ? 0.0 : falloff(found->second);
}

double AxisReach::weight(std::int32_t segment, double along_mm) const {
  if (!passes(segment)) return 0.0;
  if (segment == centre_) return falloff(std::abs(along_mm - along_));
  const geometry::TreeSegment& s = geometry::segment(tree_, segment);
  const auto from = node_distance_.find(s.from), to = node_distance_.find(s.to);
  if (from == node_distance_.end() || to == node_distance_.end()) return 0.0;
  return falloff(std::min(from->second + along_mm, to->second + s.axis.abscissa.back() - along_mm));
}

double AxisReach::weight(const geometry::Vessel& vessel, double axis_length_mm, double s_mm) const {
  double chords = 0.0;
  for (const std::int32_t id : vessel.segments) chords += geometry::segment(tree_, id).axis.abscissa.back();
  double left = std::clamp(s_mm * chords / axis_length_mm, 0.0, chords);
  for (std::size_t i = 0; i < vessel.segments.size(); ++i) {
    const double length = geometry::segment(tree_, vessel.segments[i]).axis.abscissa.back();
    if (left <= length || i + 1 == vessel.segments.size())
      return weight(vessel.segments[i], std::min(left, length));
    left -= length;
  }
  return 0.0;
}

void make_dense(TreeEdit& edit, std::int32_t id, double gap_mm) {
  const std::int32_t through = *edit.through({id}).begin();
  const AxisCurve& curve = *vessel(edit.before(), through).axis;
  geometry::TreeSegment& segment = edit.segment(id);
  double chords = 0.0, first = 0.0;
  for (const std::int32_t s : edit.vessel(through).segments) {
    if (s == id) first = chords;
    chords += edit.segment(s).axis.abscissa.back();
  }
  const double share = curve.length() / chords;
  const auto abscissa = [&](std::size_t i) {
    const double guess = (first + segment.axis.abscissa[i]) * share;
    return refound(curve, segment.axis.points[i], guess, 2.0);
  };
  geometry::Centerline dense = segment.axis;
  dense.points.clear();
  dense.radius.clear();
  bool changed = false;
  for (std::size_t i = 0; i < segment.axis.size(); ++i) {
    dense.points.push_back(segment.axis.points[i]);
    dense.radius.push_back(segment.axis.radius[i]);
    if (i + 1 == segment.axis.size()) break;
    const double gap = segment.axis.abscissa[i + 1] - segment.axis.abscissa[i];
    const int pieces = static_cast<int>(std::ceil(gap / gap_mm - 1e-6));
    if (pieces < 2) continue;
    const double from = abscissa(i), to = abscissa(i + 1);
    for (int k = 1; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces;
      dense.points.push_back(curve.point(from + t * (to - from)));
      dense.radius.push_back(segment.axis.radius[i] +
                             t * (segment.axis.radius[i + 1] - segment.axis.radius[i]));
    }
    changed = true;
  }
  if (!changed) return;
  segment.axis = std::move(dense);
  edit.axis_changed(id);
}

void move_axes(TreeEdit& edit, const AxisReach& reach, const Vec3& shift) {
  for (const geometry::TreeSegment& still : reach.tree().segments) {
    if (!reach.passes(still.id)) continue;
    bool moved = false;
    geometry::Centerline& axis = edit.segment(still.id).axis;
    for (std::size_t i = 0; i < still.axis.size(); ++i) {
      double weight = reach.weight(still.id, still.axis.abscissa[i]);
      if (i == 0) weight = reach.weight_at_node(still.from);
      if (i + 1 == still.axis.size()) weight = reach.weight_at_node(still.to);
      if (weight <= 0.0) continue;
      axis.points[i] = still.axis.points[i] + weight * shift;
      moved = true;
    }
    if (moved) edit.axis_changed(still.id);
  }
  for (geometry::TreeNode& node : edit.tree().nodes) {
    const double weight = reach.weight_at_node(node.id);
    if (weight > 0.0) node.position += weight * shift;
  }
}

std::vector<SurfaceSample> moved_samples(const VesselLumen& before, const VesselLumen& after,
                                         const std::function<double(double)>& weight, const Vec3& shift,
                                         const AbscissaMap& map) {
  std::vector<SurfaceSample> samples = before.samples;
  for (SurfaceSample& sample : samples) {
    const double s = sample.s_mm, guess = map(s), w = weight(s);
    const Vec3 axis = before.axis->point(s), offset = sample.position - axis;
    if (w > 0.0) {
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond::FromTwoVectors(before.axis->frame(s).tangent, after.axis->frame(guess).tangent);
      sample.position = axis + w * shift + turn * offset;
      sample.normal = (turn * sample.normal).normalized();
    }
    const double found = refound(*after.axis, sample.position, guess, 1.0 + offset.norm());
    if (std::abs(found - s) > 1e-9) sample.s_mm = found;
  }
  return samples;
}

}  // namespace ostia::lumen
