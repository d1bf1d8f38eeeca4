#include "triangle_meeting.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <utility>

namespace ostia::geometry::detail {
namespace {

// Its predicates are exact: the sign of a determinant of the doubles as they are.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;

Point3 exact(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

int turn(const Point2& a, const Point2& b, const Point2& c) {
  return CGAL::orientation(a, b, c);
}

/// Exact tests within one plane, seen along an axis along which the triangle keeps its area.
class Flat {
 public:
  explicit Flat(const Corners& t) {
    for (axis_ = 2; axis_ > 0; --axis_) {
      if (turn(drop(t[0]), drop(t[1]), drop(t[2])) != 0) break;
    }
    for (std::size_t i = 0; i < 3; ++i) corners_[i] = drop(t[i]);
    if (turn(corners_[0], corners_[1], corners_[2]) < 0) std::swap(corners_[1], corners_[2]);
  }

  bool contains(const Vec3& point) const {
    const Point2 p = drop(point);
    for (std::size_t i = 0; i < 3; ++i) {
      if (turn(corners_[i], corners_[(i + 1) % 3], p) < 0) return false;
    }
    return true;
  }

  bool meets(const Vec3& from, const Vec3& to) const {
    if (contains(from) || contains(to)) return true;
    const Point2 a = drop(from), b = drop(to);
    for (std::size_t i = 0; i < 3; ++i) {
      if (cross(a, b, corners_[i], corners_[(i + 1) % 3])) return true;
    }
    return false;
  }

 private:
  Point2 drop(const Vec3& p) const {
    if (axis_ == 2) return {p.x(), p.y()};
    if (axis_ == 1) return {p.z(), p.x()};
    return {p.y(), p.z()};
  }

  static bool in_box(const Point2& a, const Point2& b, const Point2& p) {
    return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) &&
           std::min(a.y(), b.y()) <= p.y() && p.y() <= std::max(a.y(), b.y());
  }

  static bool cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    const int c_side = turn(a, b, c), d_side = turn(a, b, d);
    const int a_side = turn(c, d, a), b_side = turn(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && in_box(a, b, c)) || (d_side == 0 && in_box(a, b, d)) ||
           (a_side == 0 && in_box(c, d, a)) || (b_side == 0 && in_box(c, d, b));
  }

  int axis_ = 2;
  std::array<Point2, 3> corners_;
};

/// Does the segment meet the triangle? The sides of its ends are known.
bool segment_meets(const Vec3& from, const Vec3& to, int from_side, int to_side, const Corners& t) {
  if (from_side * to_side > 0) return false;
  if (from_side == 0 && to_side == 0) return Flat(t).meets(from, to);
  // The segment reaches the plane, and at one point: the line must pass the three edges on the same side.
  int positive = 0, negative = 0;
  const Point3 a = exact(from), b = exact(to);
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = CGAL::orientation(a, b, exact(t[i]), exact(t[(i + 1) % 3]));
    positive += side > 0;
    negative += side < 0;
  }
  return positive == 0 || negative == 0;
}

bool one_sided(const std::array<int, 3>& sides) {
  return (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
}

/// Triangles without a common vertex.
bool apart_meet(const NamedTriangle& a, const Corners& b) {
  std::array<int, 3> of_b{}, of_a{};
  for (std::size_t i = 0; i < 3; ++i) of_b[i] = a.plane.side(b[i]);
  if (one_sided(of_b)) return false;
  const SidePlane plane(b);
  for (std::size_t i = 0; i < 3; ++i) of_a[i] = plane.side(a.corners[i]);
  if (one_sided(of_a)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets(a.corners[i], a.corners[j], of_a[i], of_a[j], b) ||
        segment_meets(b[i], b[j], of_b[i], of_b[j], a.corners))
      return true;
  }
  return false;
}

using Places = std::array<std::size_t, 3>;  // of a triangle's corners, those in common first

/// Triangles with one corner in common. Both are convex, so whatever else they share reaches, on the ray from
/// that corner, the opposite edge of one of them.
bool fans_meet(const NamedTriangle& a, const Places& in_a, const Corners& b, const Places& in_b) {
  const Vec3 &p = b[in_b[1]], &q = b[in_b[2]];
  const int of_p = a.plane.side(p), of_q = a.plane.side(q);
  if (of_p * of_q > 0) return false;  // `b` lies on one side of a's plane but for the corner
  const SidePlane plane(b);
  const Vec3 &u = a.corners[in_a[1]], &v = a.corners[in_a[2]];
  const int of_u = plane.side(u), of_v = plane.side(v);
  if (of_u * of_v > 0) return false;
  return segment_meets(u, v, of_u, of_v, b) || segment_meets(p, q, of_p, of_q, a.corners);
}

/// Triangles with two corners in common meet elsewhere only when folded flat onto each other.
bool wings_meet(const NamedTriangle& a, const Places& in_a, const Vec3& tip) {
  return a.plane.side(tip) == 0 &&
         CGAL::coplanar_orientation(exact(a.corners[in_a[0]]), exact(a.corners[in_a[1]]),
                                    exact(a.corners[in_a[2]]), exact(tip)) == CGAL::POSITIVE;
}

}  // namespace

SidePlane::SidePlane(const Corners& corners) : corners_(corners) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
  normal_ = u.cross(v);
  reach_ = u.cwiseAbs().cwiseMax(v.cwiseAbs());
}

int SidePlane::side(const Vec3& point) const {
  const Vec3 d = point - corners_[0];
  const double determinant = normal_.dot(d);
  // Rounding is less than this part of the product of the largest differences along the three axes, as CGAL's
  // filter for the same sum of products has it, as long as nothing under- or overflows.
  constexpr double rounding = 5.1107127829973299e-15, least = 1e-97, most = 1e102;
  const double x = std::max(reach_.x(), std::abs(d.x())), y = std::max(reach_.y(), std::abs(d.y())),
               z = std::max(reach_.z(), std::abs(d.z()));
  const double bound = rounding * x * y * z;
  const bool in_range = std::min({x, y, z}) > least && std::max({x, y, z}) < most;
  if (in_range && determinant > bound) return 1;
  if (in_range && determinant < -bound) return -1;
  return exact_side(point);
}

int SidePlane::exact_side(const Vec3& point) const {
  return CGAL::orientation(exact(corners_[0]), exact(corners_[1]), exact(corners_[2]), exact(point));
}

bool triangles_meet(const NamedTriangle& a, const Triangle& names, const Corners& b) {
  Places in_a{0, 1, 2}, in_b{0, 1, 2};
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j) {
      if (a.names[in_a[i]] != names[in_b[j]]) continue;
      std::swap(in_a[shared], in_a[i]);
      std::swap(in_b[shared], in_b[j]);
      ++shared;
      break;
    }
  if (shared == 0) return apart_meet(a, b);
  if (shared == 1) return fans_meet(a, in_a, b, in_b);
  return shared == 3 || wings_meet(a, in_a, b[in_b[2]]);
}

bool is_collinear(const Corners& triangle) {
  return CGAL::collinear(exact(triangle[0]), exact(triangle[1]), exact(triangle[2]));
}

}  // namespace ostia::geometry::detail
