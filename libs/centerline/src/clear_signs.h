#pragma once
// Signs of geometric determinants where rounding leaves no doubt of them; 0 otherwise. Rounding is bounded by
// a multiple of the longest edge from the last point, to the power that the determinant has: 45 units
// of 1.1e-16 for three edges, 400 for three and a square, both taken twice.

#include <algorithm>

namespace ostia::centerline {

/// On one cache line's half.
struct alignas(32) PlainPoint {
  double x = 0.0, y = 0.0, z = 0.0;
};

struct PlainEdge {
  PlainEdge(const PlainPoint& from, const PlainPoint& to)
      : x(to.x - from.x), y(to.y - from.y), z(to.z - from.z), squared(x * x + y * y + z * z) {}
  double x, y, z, squared;
};

/// Both of them squared: no root is needed.
inline int clear_sign(double value, double bound_squared) {
  constexpr double near_nothing = 1e-280;  // the roundings of numbers below the normal ones are larger
  if (!(bound_squared > near_nothing) || !(value * value > bound_squared)) return 0;
  return value > 0.0 ? 1 : -1;
}

/// Positive where p, q, r, s are positively oriented: (q - p) x (r - p) points to the side of s.
inline int clear_orientation(const PlainPoint& p, const PlainPoint& q, const PlainPoint& r,
                             const PlainPoint& s) {
  const PlainEdge a(s, p), b(s, q), c(s, r);
  const double determinant =
      a.z * (b.x * c.y - c.x * b.y) - b.z * (a.x * c.y - c.x * a.y) + c.z * (a.x * b.y - b.x * a.y);
  const double longest2 = std::max(a.squared, std::max(b.squared, c.squared));
  return -clear_sign(determinant, 1e-28 * longest2 * longest2 * longest2);
}

/// Positive where the last point is inside the sphere about four positively oriented ones.
inline int clear_side_of_sphere(const PlainPoint& p, const PlainPoint& q, const PlainPoint& r,
                                const PlainPoint& s, const PlainPoint& point) {
  const PlainEdge a(point, p), b(point, q), c(point, r), d(point, s);
  const double ab = a.x * b.y - b.x * a.y, ac = a.x * c.y - c.x * a.y, ad = a.x * d.y - d.x * a.y;
  const double bc = b.x * c.y - c.x * b.y, bd = b.x * d.y - d.x * b.y, cd = c.x * d.y - d.x * c.y;
  const double abc = a.z * bc - b.z * ac + c.z * ab, abd = a.z * bd - b.z * ad + d.z * ab;
  const double acd = a.z * cd - c.z * ad + d.z * ac, bcd = b.z * cd - c.z * bd + d.z * bc;
  const double determinant = (a.squared * bcd - b.squared * acd) + (c.squared * abd - d.squared * abc);
  const double longest2 = std::max(std::max(a.squared, b.squared), std::max(c.squared, d.squared));
  return clear_sign(determinant, 1e-26 * (longest2 * longest2) * (longest2 * longest2) * longest2);
}

}  // namespace ostia::centerline
