#pragma once
/// \file From a path on the Voronoi diagram to a smooth, centred axis.

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::centerline {

/// A curve given by points, with the inscribed radius at each.
struct Axis {
  std::vector<geometry::Vec3> points;
  std::vector<double> radius;  ///< mm
};

/// The axis at equal steps no longer than `step_mm`, linear between points, ends kept. Coincident neighbours
/// are joined.
Axis at_equal_steps(const Axis& axis, double step_mm);

/// A smoothing spline in arc length that removes waves shorter than `cutoff_radii` local radii (half of a
/// wave of that length remains). Its weights follow the inverse fourth power of the radius, so that the cut
/// is relative to the local size; `bound_mm`, the surface's spacing at each point, stands for the radius
/// where that is smaller. No point moves farther than its bound: where it would, the weights are raised. Both
/// ends stay; the points are about equally spaced.
Axis smoothed_axis(const Axis& axis, double cutoff_radii, const std::vector<double>& bound_mm);

/// A branch led smoothly out of its parent: a smoothing spline through `parent` (the points that lead up to
/// the branch's first, kept as they are) and the branch, which follows its own points the more closely the
/// farther they are from the joint.
Axis led_out_of(const std::vector<geometry::Vec3>& parent, const Axis& branch, double cutoff_radii);

/// The wall of a vessel as the fit sees it. Built once, safe from many threads.
class Wall {
 public:
  /// `wall` is outward and without caps; `tree` is of its triangles, where one is there already. Throws
  /// InvalidInput when it is empty.
  explicit Wall(const geometry::TriMesh& wall, std::shared_ptr<const geometry::AabbTree> tree = nullptr);

  /// Distance to the wall, caps left out, in mm. The chord error of the flat triangles is taken out by the
  /// vertices' normals: the foot moves by half of the weighted mean of its projections on the corners'
  /// tangent planes, which is exact to second order.
  double distance(const geometry::Vec3& query) const;

  /// Radius of the inscribed sphere about `centre`, mm: halfway between `distance`, a lower bound where the
  /// wall bulges outward between its points, and the distance to the nearest point (the Voronoi diagram's
  /// radius), an upper bound for any wall through the points.
  double inscribed_radius(const geometry::Vec3& centre) const;

  /// Points that triangles use.
  const std::vector<geometry::Vec3>& points() const { return cloud_.points(); }
  /// Mean length of the edges at point i, mm.
  const std::vector<double>& spacing() const { return spacing_; }
  /// Mean spacing near each point of an axis.
  std::vector<double> spacing_along(const Axis& axis) const;

 private:
  std::vector<geometry::Vec3> normals_;
  std::vector<double> spacing_;
  std::vector<geometry::Triangle> triangles_;  // the tree's, into points()
  std::shared_ptr<const geometry::AabbTree> tree_;
  geometry::KdTree cloud_;
};

/// Moves each point in its normal plane to the centre of the wall around it: a least-squares circle through
/// the wall's points near the plane (unfolded along the axis, with a linear change of radius), which weighs
/// the wall the less the farther it lies beyond the inscribed circle, so that an axis stays that of the
/// inscribed sphere where the section is not round. No point ends farther than `bound_mm` from where it
/// began. Both ends stay.
Axis recentred_axis(const Axis& axis, const Wall& wall, const std::vector<double>& bound_mm,
                    double cutoff_radii, const core::TaskContext& task = core::no_task());

}  // namespace ostia::centerline
