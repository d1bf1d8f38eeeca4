#include "edge_table.h"
#include "mesh_checks.h"
#include "morton_leaves.h"

#include "ostia/core/error.h"
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

using detail::BvhBox;

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

/// What a triangle is where it counts: it has an area, and finite points.
struct Candidate {
  BvhBox box;
  Triangle corners;        // the first of equal points
  std::int32_t name = -1;  // its index in the mesh
  bool wanted = true;
};

class Search {
 public:
  /// Of pairs of which at least one triangle is marked; no marks: of all pairs.
  Search(const TriMesh& mesh, const std::vector<std::uint8_t>* marks) {
    points_.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) points_.emplace_back(p.x(), p.y(), p.z());
    const std::vector<Candidate> candidates = candidates_of(mesh, marks);
    std::vector<BvhBox> boxes(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) boxes[i] = candidates[i].box;
    leaves_ = detail::morton_leaves(boxes);
    // In the order of the leaves: then a leaf's triangles lie side by side in memory.
    items_.resize(candidates.size());
    core::parallel_for(items_.size(), 4096, [&](std::size_t i) {
      items_[i] = candidates[static_cast<std::size_t>(leaves_.order[i])];
    });
    if (marks != nullptr) mark_levels();
  }

  std::size_t leaves() const { return leaves_.leaves(); }

  /// Appends the pairs of a leaf's triangles with each other and with those of later leaves.
  void add_pairs(std::size_t leaf, std::vector<Pair>& pairs) const {
    const bool all = wanted_.empty() || wanted_[0][leaf] != 0;
    detail::for_later_leaves(
        leaves_, leaf,
        [&](std::size_t level, std::size_t index) { return all || wanted_[level][index] != 0; },
        [&](std::size_t other) { add_pairs(leaf, other, pairs); });
  }

 private:
  const Point3& at(std::int32_t p) const { return points_[static_cast<std::size_t>(p)]; }

  std::vector<Candidate> candidates_of(const TriMesh& mesh, const std::vector<std::uint8_t>* marks) const {
    const std::vector<std::int32_t> same = detail::first_equal_points(mesh.points);
    std::vector<Candidate> candidates(mesh.triangles.size());
    core::parallel_for(mesh.triangles.size(), 4096, [&](std::size_t t) {
      Candidate candidate{BvhBox::nothing(), mesh.triangles[t], static_cast<std::int32_t>(t),
                          marks == nullptr || (*marks)[t] != 0};
      bool counts = true;
      for (std::int32_t& p : candidate.corners) {
        p = same[static_cast<std::size_t>(p)];
        counts = counts && mesh.points[static_cast<std::size_t>(p)].allFinite();
        candidate.box.extend(mesh.points[static_cast<std::size_t>(p)].data());
      }
      const Triangle& c = candidate.corners;
      counts = counts && !detail::repeats_a_corner(c) && !CGAL::collinear(at(c[0]), at(c[1]), at(c[2]));
      if (!counts) candidate.name = -1;
      candidates[t] = candidate;
    });
    std::erase_if(candidates, [](const Candidate& candidate) { return candidate.name < 0; });
    return candidates;
  }

  void mark_levels() {
    for (const auto& level : leaves_.levels) wanted_.emplace_back(level.size(), 0);
    for (std::size_t i = 0; i < items_.size(); ++i) {
      if (!items_[i].wanted) continue;
      const std::size_t leaf = i / detail::MortonLeaves::per_leaf;
      for (std::size_t k = 0; k < wanted_.size(); ++k) wanted_[k][leaf >> k] = 1;
    }
  }

  void add_pairs(std::size_t leaf, std::size_t other, std::vector<Pair>& pairs) const {
    for (std::size_t i = leaves_.first(leaf); i < leaves_.last(leaf); ++i) {
      const Candidate& one = items_[i];
      if (!one.box.overlaps(leaves_.levels[0][other])) continue;
      for (std::size_t j = std::max(i + 1, leaves_.first(other)); j < leaves_.last(other); ++j) {
        const Candidate& two = items_[j];
        if (one.box.overlaps(two.box) && (one.wanted || two.wanted) && meet(one.corners, two.corners))
          pairs.emplace_back(std::min(one.name, two.name), std::max(one.name, two.name));
      }
    }
  }

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
  detail::MortonLeaves leaves_;
  std::vector<Candidate> items_;                   // in the leaves' order
  std::vector<std::vector<std::uint8_t>> wanted_;  // by level and node; empty: all are
};

std::vector<Pair> pairs_of(const Search& search, std::size_t max_pairs) {
  std::vector<Pair> pairs;
  constexpr std::size_t grain = 64;
  // In rounds, so that a search that may end early does; the rounds do not depend on the number of threads.
  const std::size_t round = max_pairs == 0 ? search.leaves() : 64 * grain;
  for (std::size_t start = 0; start < search.leaves(); start += round) {
    const std::size_t count = std::min(round, search.leaves() - start);
    std::vector<std::vector<Pair>> found((count + grain - 1) / grain);
    core::parallel_chunks(count, grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) search.add_pairs(start + i, found[first / grain]);
    });
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    if (max_pairs > 0 && pairs.size() >= max_pairs) break;
  }
  std::sort(pairs.begin(), pairs.end());
  if (max_pairs > 0 && pairs.size() > max_pairs) pairs.resize(max_pairs);
  return pairs;
}

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const TriMesh& mesh,
                                                                      std::size_t max_pairs) {
  detail::check_indices(mesh, "self-intersections");
  return pairs_of(Search(mesh, nullptr), max_pairs);
}

std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(
    const TriMesh& mesh, const std::vector<std::uint8_t>& marks) {
  detail::check_indices(mesh, "self-intersections");
  if (marks.size() != mesh.triangles.size())
    throw InvalidInput("self-intersections: there must be a mark for each triangle");
  return pairs_of(Search(mesh, &marks), 0);
}

}  // namespace ostia::geometry
