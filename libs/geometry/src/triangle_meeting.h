#pragma once
/// \file Whether two triangles intersect or touch beyond the corners that they share, exactly.

#include "ostia/geometry/tri_mesh.h"

#include <array>

namespace ostia::geometry::detail {

using Corners = std::array<Vec3, 3>;

/// On which side of a triangle's plane points lie: a determinant of which most is done once, and whose sign
/// is only worked out exactly where rounding might change it.
class SidePlane {
 public:
  explicit SidePlane(const Corners& corners);
  /// 1 where the triangle looks clockwise, -1 on its other side, 0 on its plane.
  int side(const Vec3& point) const;

 private:
  int exact_side(const Vec3& point) const;
  Corners corners_;
  Vec3 normal_, reach_;  // of the edges along each axis, the largest
};

/// A triangle that has an area. Corners of equal names are the same point.
struct NamedTriangle {
  NamedTriangle(const Triangle& its_names, const Corners& its_corners)
      : names(its_names), corners(its_corners), plane(its_corners) {}

  Triangle names;
  Corners corners;
  SidePlane plane;
};

bool triangles_meet(const NamedTriangle& a, const Triangle& names, const Corners& b);

/// No area at all: its corners lie on a line.
bool is_collinear(const Corners& triangle);

}  // namespace ostia::geometry::detail
