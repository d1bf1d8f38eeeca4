#pragma once
/// \file Where an end of a vessel would be cut across, and what is in the way.

#include "ostia/geometry/centerline.h"

#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

inline constexpr double apart_mm = 0.3;  // between two walls, so that a plane sees them as two

/// A plane across an end.
struct CutPlace {
  Vec3 place = Vec3::Zero();
  Vec3 outward = Vec3::UnitX();
  double radius_mm = 0.0;
};

/// A line from an end inwards.
class InwardLine {
 public:
  InwardLine(const geometry::Centerline& axis, bool from_first);
  double length() const { return at_mm_.back(); }
  Vec3 point(double s_mm) const;
  /// Where the end would be cut if so much of it were taken away: as meshes are cut.
  CutPlace cut(double trimmed_mm) const;

 private:
  double radius_at(double s_mm) const;
  std::vector<Vec3> points_;
  std::vector<double> radius_, at_mm_;
};

/// Where meshes of cases are cut, from the end of the axis inwards.
double cut_inside_mm(double radius_mm);
/// Whether a vessel's ball lies in the way of a cut and the dome beyond it.
bool in_the_way(const CutPlace& cut, const Vec3& centre, double radius_mm);

}  // namespace ostia::coronary
