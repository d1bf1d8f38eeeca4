#pragma once
/// \file The measure that tetrahedra are improved by.

#include "ostia/geometry/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::meshing {

/// Weight of large dihedral angles against small ones: 162 degrees count as 13 do.
constexpr double large_angle_weight = 0.5;

/// 1 - cos of the smallest dihedral angle, or large_angle_weight (1 + cos) of the largest where that is less;
/// 0 or negative, the volume times six, where the volume is not positive. Grows with the quality; at most
/// 0.67.
inline double tetrahedron_quality(const geometry::Vec3& a, const geometry::Vec3& b, const geometry::Vec3& c,
                                  const geometry::Vec3& d) {
  using geometry::Vec3;
  const Vec3 u = b - a, v = c - a, w = d - a;
  // Normals of the faces opposite d, c, b, a: a dihedral angle lies between two of them.
  const Vec3 n3 = v.cross(u), n2 = u.cross(w), n1 = w.cross(v), n0 = -(n1 + n2 + n3);
  const double six_volumes = -n3.dot(w);
  if (!(six_volumes > 0.0)) return six_volumes;
  const std::array<double, 4> length{n0.norm(), n1.norm(), n2.norm(), n3.norm()};
  double least = 1.0, largest = -1.0;  // cosines between normals
  auto meet = [&](const Vec3& p, const Vec3& q, double lengths) {
    const double cosine = p.dot(q) / lengths;
    least = std::min(least, cosine);
    largest = std::max(largest, cosine);
  };
  meet(n0, n1, length[0] * length[1]);
  meet(n0, n2, length[0] * length[2]);
  meet(n0, n3, length[0] * length[3]);
  meet(n1, n2, length[1] * length[2]);
  meet(n1, n3, length[1] * length[3]);
  meet(n2, n3, length[2] * length[3]);
  return std::min(1.0 + least, large_angle_weight * (1.0 - largest));
}

/// The quality of a tetrahedron whose smallest dihedral angle is this.
inline double quality_of_angle(double degrees) {
  return 1.0 - std::cos(degrees * std::numbers::pi / 180.0);
}

}  // namespace ostia::meshing
