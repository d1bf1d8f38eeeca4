#include "edge_table.h"
#include "mesh_checks.h"
#include "morton_leaves.h"
#include "triangle_meeting.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::geometry {
namespace {

using detail::BvhBox;
using detail::Corners;
using detail::FloatBox;
using detail::LeafNode;
using Pair = std::pair<std::int32_t, std::int32_t>;

constexpr std::size_t grain = 4096;
constexpr std::size_t unit_level = 6;  // of the nodes whose pairs are looked for at once

class Search {
 public:
  /// Of pairs of which at least one triangle is marked; no marks: of all pairs.
  Search(const TriMesh& mesh, const std::vector<std::uint8_t>* marks)
      : points_(mesh.points), triangles_(mesh.triangles) {
    rename_corners();
    leaves_ = detail::morton_leaves(boxes(choose()));
    put_in_order();
    if (marks != nullptr) mark_levels(*marks);
  }

  /// Parts of the search; each has its own pairs.
  std::size_t units() const { return leaves_.levels.empty() ? 0 : leaves_.levels[level()].size(); }

  /// Appends the pairs of a part's triangles with each other and with those of later parts.
  void add_pairs(std::size_t unit, std::vector<Pair>& pairs) const {
    const auto enter = [&](const LeafNode& a, const LeafNode& b) { return wanted(a) || wanted(b); };
    const auto visit = [&](std::size_t leaf, std::size_t other) { add_pairs(leaf, other, pairs); };
    const LeafNode node{level(), unit};
    detail::for_leaf_pairs(leaves_, node, enter, visit);
    detail::for_later_pairs(leaves_, node, {leaves_.levels.size() - 1, 0}, enter, visit);
  }

 private:
  std::size_t level() const { return std::min(unit_level, leaves_.levels.size() - 1); }
  bool wanted(const LeafNode& node) const { return wanted_.empty() || wanted_[node.level][node.index] != 0; }
  Corners corners(const Triangle& t) const {
    return {points_[static_cast<std::size_t>(t[0])], points_[static_cast<std::size_t>(t[1])],
            points_[static_cast<std::size_t>(t[2])]};
  }
  BvhBox box(const Triangle& t) const {
    BvhBox box = BvhBox::nothing();
    for (const std::int32_t p : t) box.extend(points_[static_cast<std::size_t>(p)].data());
    return box;
  }

  /// The first of equal points.
  void rename_corners() {
    const std::vector<std::int32_t> same = detail::first_equal_points(points_);
    core::parallel_for(triangles_.size(), grain, [&](std::size_t t) {
      for (std::int32_t& p : triangles_[t]) p = same[static_cast<std::size_t>(p)];
    });
  }

  /// Keeps the triangles that have an area, and finite points; tells the bounds of these.
  BvhBox choose() {
    names_.resize(triangles_.size());
    const auto look = [&](std::size_t first, std::size_t last) {
      BvhBox bounds = BvhBox::nothing();
      for (std::size_t t = first; t < last; ++t) {
        const Corners at = corners(triangles_[t]);
        const bool counts = at[0].allFinite() && at[1].allFinite() && at[2].allFinite() &&
                            !detail::repeats_a_corner(triangles_[t]) && !detail::is_collinear(at);
        names_[t] = counts ? static_cast<std::int32_t>(t) : -1;
        if (counts) bounds.extend(box(triangles_[t]));
      }
      return bounds;
    };
    const auto join = [](BvhBox a, const BvhBox& b) {
      a.extend(b);
      return a;
    };
    const BvhBox bounds = core::parallel_reduce(triangles_.size(), grain, BvhBox::nothing(), look, join);
    std::erase(names_, -1);
    return bounds;
  }

  std::vector<FloatBox> boxes(const BvhBox& bounds) const {
    const detail::UnitCube cube(bounds);
    std::vector<FloatBox> boxes(names_.size());
    core::parallel_for(boxes.size(), grain, [&](std::size_t i) {
      boxes[i] = cube(box(triangles_[static_cast<std::size_t>(names_[i])]));
    });
    return boxes;
  }

  /// As the leaves have them: then a leaf's triangles lie side by side in memory.
  void put_in_order() {
    std::vector<std::int32_t> names(names_.size());
    std::vector<Triangle> triangles(names_.size());
    core::parallel_for(names.size(), grain, [&](std::size_t i) {
      names[i] = names_[static_cast<std::size_t>(leaves_.order[i])];
      triangles[i] = triangles_[static_cast<std::size_t>(names[i])];
    });
    names_ = std::move(names);
    triangles_ = std::move(triangles);
  }

  /// Of a leaf a bit for each marked item, of a node above whether there is one below.
  void mark_levels(const std::vector<std::uint8_t>& marks) {
    for (const auto& level : leaves_.levels) wanted_.emplace_back(level.size(), 0);
    constexpr std::size_t per_leaf = detail::MortonLeaves::per_leaf;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (marks[static_cast<std::size_t>(names_[i])] == 0) continue;
      const std::size_t leaf = i / per_leaf;
      wanted_[0][leaf] = static_cast<std::uint8_t>(wanted_[0][leaf] | 1u << i % per_leaf);
      for (std::size_t k = 1; k < wanted_.size(); ++k) wanted_[k][leaf >> k] = 1;
    }
  }

  unsigned wanted_items(std::size_t leaf) const { return wanted_.empty() ? 0xffu : wanted_[0][leaf]; }

  void add_pairs(std::size_t leaf, std::size_t other, std::vector<Pair>& pairs) const {
    constexpr std::size_t per_leaf = detail::MortonLeaves::per_leaf;
    const unsigned own = wanted_items(leaf), theirs = wanted_items(other);
    for (std::size_t k = 0; k < per_leaf; ++k) {
      const FloatBox box = leaves_.boxes[leaf].box(k);
      if (!box.overlaps(leaves_.levels[0][other])) continue;
      unsigned near = leaves_.boxes[other].overlapping(box);
      if ((own >> k & 1u) == 0) near &= theirs;
      if (leaf == other) near &= 0xfeu << k;
      if (near != 0) add_pairs_of(per_leaf * leaf + k, per_leaf * other, near, pairs);
    }
  }

  /// One triangle with those of a leaf that have their bits.
  void add_pairs_of(std::size_t item, std::size_t first, unsigned bits, std::vector<Pair>& pairs) const {
    const detail::NamedTriangle one(triangles_[item], corners(triangles_[item]));
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t other = first + static_cast<std::size_t>(std::countr_zero(bits));
      if (!detail::triangles_meet(one, triangles_[other], corners(triangles_[other]))) continue;
      pairs.emplace_back(std::minmax(names_[item], names_[other]));
    }
  }

  const std::vector<Vec3>& points_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> names_;  // their indices in the mesh
  detail::MortonLeaves leaves_;
  std::vector<std::vector<std::uint8_t>> wanted_;  // by level and node; empty: all are
};

std::vector<Pair> pairs_of(const Search& search, std::size_t max_pairs) {
  std::vector<Pair> pairs;
  // In rounds, so that a search that may end early does; the rounds do not depend on the number of threads.
  const std::size_t round = max_pairs == 0 ? search.units() : 64;
  for (std::size_t start = 0; start < search.units(); start += round) {
    std::vector<std::vector<Pair>> found(std::min(round, search.units() - start));
    core::parallel_for(found.size(), 1, [&](std::size_t i) { search.add_pairs(start + i, found[i]); });
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
