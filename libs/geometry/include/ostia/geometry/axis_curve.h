#pragma once
/// \file A vessel's axis as a smooth curve: the one definition of its points, frames and feet that
/// reformations, contours and the editing of the lumen share.

#include "ostia/geometry/centerline.h"

#include <optional>
#include <vector>

namespace ostia::geometry {

/// Where a place is in a vessel's own coordinates.
struct AxisFoot {
  double s_mm = 0.0;      ///< abscissa of an orthogonal projection on the axis, or of an end
  double theta = 0.0;     ///< radial_direction's angle, in (-pi, pi]
  double rho_mm = 0.0;    ///< distance from the foot
  bool past_end = false;  ///< the foot is an end, and the place lies beyond the plane across it
};

/// A C1 curve in arc length through a centerline's points (its C2 spline, tabulated) with rotation-minimising
/// frames that start at the centerline's first normal. Immutable; asked from many threads.
class AxisCurve {
 public:
  /// Throws InvalidInput for fewer than two distinct points, points that are not finite, a radius that is not
  /// positive and finite (an empty radius array is allowed), or a line longer than 10 m.
  explicit AxisCurve(const Centerline& line);

  double length() const { return length_; }  ///< mm
  Vec3 point(double s_mm) const;             ///< clamped to the ends, as are the others
  Frame frame(double s_mm) const;            ///< tangent is the curve's exact derivative; orthonormal
  double radius(double s_mm) const;          ///< linear between the centerline's points; 0 without radii
  Vec3 curvature_vector(double s_mm) const;  ///< 1/mm, towards the centre of curvature
  /// The world point at a signed distance from the axis along radial_direction(frame(s), theta).
  Vec3 place(double s_mm, double theta, double rho_mm) const;

  /// All local minima of the distance to the axis no farther than `reach_mm` (feet of orthogonal projections,
  /// and ends where the place lies beyond them), the nearest first, ties by abscissa. In a bend tighter than
  /// the distance there are several.
  std::vector<AxisFoot> feet(const Vec3& place, double reach_mm) const;
  /// The nearest foot of all.
  AxisFoot nearest_foot(const Vec3& place) const;
  /// Of the local minima, the one nearest to an abscissa, if any within `window_mm` of it: how a walk along
  /// the vessel stays on the vessel.
  std::optional<AxisFoot> foot_near(const Vec3& place, double s_mm, double window_mm) const;

  /// The axis sampled at equal steps no longer than `step_mm`.
  Centerline sampled(double step_mm) const;

 private:
  struct Node {
    Vec3 point, tangent, normal;
  };
  struct Block {  // a ball around consecutive table intervals
    Vec3 centre;
    double radius = 0.0;
  };
  double length_ = 0.0, step_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<Block> blocks_;
  std::vector<double> radius_s_, radius_;
  std::size_t interval(double s_mm, double& t) const;
  Vec3 derivative(std::size_t i, double t) const;
  AxisFoot foot_at(double s_mm, const Vec3& place, bool past_end) const;
  void add_feet(std::size_t first, std::size_t last, const Vec3& place, double reach_mm,
                std::vector<AxisFoot>& out) const;
};

}  // namespace ostia::geometry
