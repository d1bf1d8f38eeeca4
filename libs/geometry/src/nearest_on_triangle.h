#pragma once
/// \file The point of a triangle that is nearest to a query.

#include "bvh.h"
#include "winding.h"

#include "ostia/geometry/aabb_tree.h"

#include <limits>
#include <vector>

namespace ostia::geometry::detail {

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  Vec3 weights = Vec3::Zero();
};

/// Nearest point of a triangle by the Voronoi regions of its corners, edges and interior. A triangle flagged
/// as a needle has no interior worth the name: the quotient of two roundings there could land anywhere.
Nearest nearest_on_triangle(const CornerPoints& p, bool needle, const Vec3& query);

/// Below this ratio of area to squared longest edge the interior's barycentric coordinates are mostly
/// rounding.
bool is_needle(const CornerPoints& p);

/// The plane of a triangle: no point of the triangle is nearer to a query than its plane is. Most triangles
/// about the axis of a tube are told by it alone to be no nearer than the nearest one so far.
class TrianglePlane {
 public:
  TrianglePlane() = default;
  /// Of a sliver, whose normal is mostly rounding, it tells nothing.
  explicit TrianglePlane(const CornerPoints& p);
  /// Whether the triangle cannot be nearer than the root of `squared`: on the safe side of rounding.
  bool is_beyond(const Vec3& query, double squared) const {
    constexpr double sure = 1.0 - 1e-5, rounding_mm2 = 1e-12;
    const double height = normal_.dot(query) - along_;
    return height * height * sure > squared + rounding_mm2;
  }

 private:
  Vec3 normal_ = Vec3::Zero();
  double along_ = 0.0;
};

/// The nearest triangle below `best.squared`, as its place in the order of the leaves; `best_place` and
/// `best` stay as they are when there is none. `triangles`, `needles` and `planes` in that order.
void search_nearest(const Bvh& bvh, const std::vector<CornerPoints>& triangles,
                    const std::vector<char>& needles, const std::vector<TrianglePlane>& planes,
                    const Vec3& query, Nearest& best, std::int32_t& best_place);

/// What a search has found: triangle -1 when `place` is below 0.
SurfacePoint surface_point(const Bvh& bvh, const std::vector<CornerPoints>& triangles, const Vec3& query,
                           const Nearest& best, std::int32_t place);

}  // namespace ostia::geometry::detail
