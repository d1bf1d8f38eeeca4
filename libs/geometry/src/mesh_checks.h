#pragma once
/// \file Checks that every function on triangle surfaces makes first.

#include "ostia/core/error.h"
#include "ostia/geometry/tri_mesh.h"

#include <algorithm>
#include <string>

namespace ostia::geometry::detail {

/// Throws InvalidInput when a triangle names a point that is not there.
inline void check_indices(const TriMesh& mesh, const char* who) {
  const auto count = mesh.points.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::int32_t p : mesh.triangles[t]) {
      if (p >= 0 && static_cast<std::size_t>(p) < count) continue;
      throw InvalidInput(std::string(who) + ": triangle " + std::to_string(t) + " names point " +
                         std::to_string(p) + ", but the surface has " + std::to_string(count) +
                         " points; the file is damaged");
    }
  }
}

/// Throws InvalidInput when a used point is not finite.
inline void check_finite(const TriMesh& mesh, const char* who) {
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::int32_t p : triangle) {
      if (mesh.points[static_cast<std::size_t>(p)].allFinite()) continue;
      throw InvalidInput(
          std::string(who) + ": point " + std::to_string(p) +
          " has a coordinate that is not a finite number; repair the surface with welded() first");
    }
  }
}

inline const Vec3& corner(const TriMesh& mesh, const Triangle& triangle, int i) {
  return mesh.points[static_cast<std::size_t>(triangle[static_cast<std::size_t>(i)])];
}

inline bool repeats_a_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Repeated corner, or a height below 1e-12 of the longest edge: no area beyond rounding.
inline bool is_degenerate(const TriMesh& mesh, const Triangle& triangle) {
  if (repeats_a_corner(triangle)) return true;
  const Vec3 u = corner(mesh, triangle, 1) - corner(mesh, triangle, 0);
  const Vec3 v = corner(mesh, triangle, 2) - corner(mesh, triangle, 1);
  const Vec3 w = corner(mesh, triangle, 0) - corner(mesh, triangle, 2);
  const double longest = std::max({u.norm(), v.norm(), w.norm()});
  return !(u.cross(v).norm() > 1e-12 * longest * longest);
}

}  // namespace ostia::geometry::detail
