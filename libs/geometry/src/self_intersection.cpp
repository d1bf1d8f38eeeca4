#include "bvh.h"
#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::geometry {
namespace {

using detail::Bvh;
using detail::BvhBox;
using detail::BvhNode;

// Its predicates are exact: the sign of a determinant of the doubles as they are.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Corners = std::array<const Point3*, 3>;
using Pair = std::pair<std::int32_t, std::int32_t>;

int side(const Corners& t, const Point3& p) {
  return CGAL::orientation(*t[0], *t[1], *t[2], p);
}

/// Exact tests within one plane, seen along an axis along which the triangle keeps its area.
class Flat {
 public:
  explicit Flat(const Corners& t) {
    for (axis_ = 2; axis_ > 0; --axis_) {
      if (CGAL::orientation(drop(*t[0]), drop(*t[1]), drop(*t[2])) != CGAL::COLLINEAR) break;
    }
    for (std::size_t i = 0; i < 3; ++i) corners_[i] = drop(*t[i]);
    if (CGAL::orientation(corners_[0], corners_[1], corners_[2]) == CGAL::RIGHT_TURN)
      std::swap(corners_[1], corners_[2]);
  }

  bool contains(const Point3& point) const {
    const Point2 p = drop(point);
    for (std::size_t i = 0; i < 3; ++i) {
      if (CGAL::orientation(corners_[i], corners_[(i + 1) % 3], p) == CGAL::RIGHT_TURN) return false;
    }
    return true;
  }

  bool meets(const Point3& from, const Point3& to) const {
    if (contains(from) || contains(to)) return true;
    const Point2 a = drop(from), b = drop(to);
    for (std::size_t i = 0; i < 3; ++i) {
      if (cross(a, b, corners_[i], corners_[(i + 1) % 3])) return true;
    }
    return false;
  }

 private:
  Point2 drop(const Point3& p) const {
    if (axis_ == 2) return {p.x(), p.y()};
    if (axis_ == 1) return {p.z(), p.x()};
    return {p.y(), p.z()};
  }

  static bool in_box(const Point2& a, const Point2& b, const Point2& p) {
    return std::min(a.x(), b.x()) <= p.x() && p.x() <= std::max(a.x(), b.x()) &&
           std::min(a.y(), b.y()) <= p.y() && p.y() <= std::max(a.y(), b.y());
  }

  static bool cross(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    const int c_side = CGAL::orientation(a, b, c), d_side = CGAL::orientation(a, b, d);
    const int a_side = CGAL::orientation(c, d, a), b_side = CGAL::orientation(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && in_box(a, b, c)) || (d_side == 0 && in_box(a, b, d)) ||
           (a_side == 0 && in_box(c, d, a)) || (b_side == 0 && in_box(c, d, b));
  }

  int axis_ = 2;
  std::array<Point2, 3> corners_;
};

/// Does the segment meet the triangle? The sides of its ends are known.
bool segment_meets(const Point3& from, const Point3& to, int from_side, int to_side, const Corners& t) {
  if (from_side * to_side > 0) return false;
  if (from_side == 0 && to_side == 0) return Flat(t).meets(from, to);
  // The segment reaches the plane, and at one point: the line must pass the three edges on the same side.
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int turn = CGAL::orientation(from, to, *t[i], *t[(i + 1) % 3]);
    positive += turn > 0;
    negative += turn < 0;
  }
  return positive == 0 || negative == 0;
}

bool one_sided(const std::array<int, 3>& sides) {
  return (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
}

/// Triangles without a common vertex.
bool apart_meet(const Corners& a, const Corners& b) {
  std::array<int, 3> of_b{}, of_a{};
  for (std::size_t i = 0; i < 3; ++i) of_b[i] = side(a, *b[i]);
  if (one_sided(of_b)) return false;
  for (std::size_t i = 0; i < 3; ++i) of_a[i] = side(b, *a[i]);
  if (one_sided(of_a)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets(*a[i], *a[j], of_a[i], of_a[j], b) || segment_meets(*b[i], *b[j], of_b[i], of_b[j], a))
      return true;
  }
  return false;
}

/// Triangles with corner 0 in common. Both are convex, so whatever else they share reaches, on the ray from
/// that corner, the opposite edge of one of them.
bool fans_meet(const Corners& a, const Corners& b) {
  const int a1 = side(b, *a[1]), a2 = side(b, *a[2]);
  if (a1 * a2 > 0) return false;  // `a` lies on one side of b's plane but for the corner
  const int b1 = side(a, *b[1]), b2 = side(a, *b[2]);
  if (b1 * b2 > 0) return false;
  return segment_meets(*a[1], *a[2], a1, a2, b) || segment_meets(*b[1], *b[2], b1, b2, a);
}

/// Triangles with corners 0 and 1 in common meet elsewhere only when folded flat onto each other.
bool wings_meet(const Corners& a, const Corners& b) {
  return side(a, *b[2]) == 0 && CGAL::coplanar_orientation(*a[0], *a[1], *a[2], *b[2]) == CGAL::POSITIVE;
}

class Search {
 public:
  explicit Search(const TriMesh& mesh) : same_(detail::first_equal_points(mesh.points)) {
    points_.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) points_.emplace_back(p.x(), p.y(), p.z());
    std::vector<BvhBox> boxes;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle corners = mesh.triangles[t];
      bool finite = true;
      BvhBox box = BvhBox::nothing();
      for (std::int32_t& p : corners) {
        p = same_[static_cast<std::size_t>(p)];
        finite = finite && mesh.points[static_cast<std::size_t>(p)].allFinite();
        box.extend(mesh.points[static_cast<std::size_t>(p)].data());
      }
      if (!finite || detail::repeats_a_corner(corners) ||
          CGAL::collinear(at(corners[0]), at(corners[1]), at(corners[2]))) {
        continue;
      }
      corners_.push_back(corners);
      names_.push_back(static_cast<std::int32_t>(t));
      boxes.push_back(box);
    }
    bvh_ = detail::build_bvh(boxes);
    boxes_ = std::move(boxes);
  }

  std::size_t size() const { return corners_.size(); }

  /// Appends the pairs of triangle `i` with later ones, ascending.
  void add_pairs(std::size_t i, std::vector<Pair>& pairs) const {
    const std::size_t before = pairs.size();
    std::int32_t stack[detail::bvh_stack_size];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::int32_t index = stack[--size];
      const BvhNode& node = bvh_.nodes[static_cast<std::size_t>(index)];
      if (!node.box.overlaps(boxes_[i])) continue;
      if (node.count == 0) {
        stack[size++] = node.next;
        stack[size++] = index + 1;
        continue;
      }
      for (std::int32_t place = node.next; place < node.next + node.count; ++place) {
        const auto j = static_cast<std::size_t>(bvh_.order[static_cast<std::size_t>(place)]);
        if (j > i && boxes_[i].overlaps(boxes_[j]) && meet(corners_[i], corners_[j])) {
          pairs.emplace_back(names_[i], names_[j]);
        }
      }
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(before), pairs.end());
  }

 private:
  const Point3& at(std::int32_t p) const { return points_[static_cast<std::size_t>(p)]; }

  /// Tells how many corners the triangles share, with those first.
  bool meet(Triangle a, Triangle b) const {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = shared; j < 3; ++j) {
        if (a[i] != b[j]) continue;
        std::swap(b[shared], b[j]);
        std::swap(a[shared], a[i]);
        ++shared;
        break;
      }
    }
    const Corners p{&at(a[0]), &at(a[1]), &at(a[2])}, q{&at(b[0]), &at(b[1]), &at(b[2])};
    if (shared == 0) return apart_meet(p, q);
    if (shared == 1) return fans_meet(p, q);
    return shared == 3 || wings_meet(p, q);
  }

  std::vector<Point3> points_;
  std::vector<std::int32_t> same_;
  std::vector<Triangle> corners_;    // of the triangles with an area
  std::vector<std::int32_t> names_;  // their indices in the mesh
  std::vector<BvhBox> boxes_;
  Bvh bvh_;
};

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const TriMesh& mesh,
                                                                      std::size_t max_pairs) {
  detail::check_indices(mesh, "self-intersections");
  const Search search(mesh);
  std::vector<Pair> pairs;
  constexpr std::size_t grain = 256;
  // In rounds, so that a search that may end early does; the rounds do not depend on the number of threads.
  const std::size_t round = max_pairs == 0 ? search.size() : 64 * grain;
  for (std::size_t start = 0; start < search.size(); start += round) {
    const std::size_t count = std::min(round, search.size() - start);
    std::vector<std::vector<Pair>> found((count + grain - 1) / grain);
    core::parallel_chunks(count, grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) search.add_pairs(start + i, found[first / grain]);
    });
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    if (max_pairs > 0 && pairs.size() >= max_pairs) {
      pairs.resize(max_pairs);
      break;
    }
  }
  return pairs;
}

}  // namespace ostia::geometry
