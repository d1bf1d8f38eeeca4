// Regions of a surface, and what is measured of them.

#include "cutting/cap_regions.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace ostia::meshing {

using geometry::Triangle;
using geometry::TriMesh;
using geometry::Vec3;

Vec3 doubled_area(const TriMesh& mesh, std::int32_t triangle) {
  const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  const Vec3& a = mesh.points[static_cast<std::size_t>(t[0])];
  return (mesh.points[static_cast<std::size_t>(t[1])] - a)
      .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
}

namespace {

/// A cap is as wide as the lumen behind it, within these factors.
constexpr double narrowest_cap = 0.6, widest_cap = 1.67;
constexpr std::array depths_radii{0.5, 1.5};

std::vector<SharedEdge> shared_edges(const TriMesh& mesh) {
  struct Side {
    std::int32_t low, high, triangle;
  };
  std::vector<std::size_t> next(mesh.points.size() + 1, 0);
  const auto for_each_side = [&](const auto& use) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
        use(Side{low, high, static_cast<std::int32_t>(i)});
      }
  };
  // Counted into their places by the lower point, the few of each sorted there.
  for_each_side([&](const Side& side) { ++next[static_cast<std::size_t>(side.low) + 1]; });
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Side> sides(next.back());
  for_each_side([&](const Side& side) { sides[next[static_cast<std::size_t>(side.low)]++] = side; });
  const auto in_order = [](const Side& a, const Side& b) {
    return a.high < b.high || (a.high == b.high && a.triangle < b.triangle);
  };
  for (std::size_t v = 0, first = 0; v + 1 < next.size(); first = next[v++])
    std::sort(sides.begin() + static_cast<std::ptrdiff_t>(first),
              sides.begin() + static_cast<std::ptrdiff_t>(next[v]), in_order);
  std::vector<SharedEdge> edges;
  edges.reserve(sides.size() / 2 + 1);
  for (const Side& s : sides) {
    if (!edges.empty() && edges.back().a == s.low && edges.back().b == s.high)
      edges.back().right = s.triangle;
    else
      edges.push_back({s.low, s.high, s.triangle, -1});
  }
  return edges;
}

/// A rim whose points have two of its edges each and hang together is one loop.
bool is_one_loop(const Look& look, const std::vector<std::size_t>& rim) {
  std::map<std::int32_t, std::vector<std::int32_t>> next;
  for (const std::size_t k : rim) {
    next[look.edges[k].a].push_back(look.edges[k].b);
    next[look.edges[k].b].push_back(look.edges[k].a);
  }
  if (next.size() < 3) return false;
  for (const auto& [point, others] : next)
    if (others.size() != 2) return false;
  std::size_t steps = 0;
  std::int32_t before = -1, at = next.begin()->first;
  do {
    const std::vector<std::int32_t>& others = next[at];
    const std::int32_t to = others[0] == before ? others[1] : others[0];
    before = at;
    at = to;
    ++steps;
  } while (at != next.begin()->first && steps <= next.size());
  return steps == next.size();
}

}  // namespace

Look::Look(const TriMesh& m) : mesh(m), edges(shared_edges(m)) {
  for (std::size_t i = 0; i < m.triangles.size(); ++i)
    normals.push_back(doubled_area(m, static_cast<std::int32_t>(i)).normalized());
}

double Look::angle_deg(const SharedEdge& e) const {
  const double cosine =
      normals[static_cast<std::size_t>(e.left)].dot(normals[static_cast<std::size_t>(e.right)]);
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

std::vector<Region> regions(const Look& look, const std::function<bool(const SharedEdge&)>& same) {
  geometry::DisjointSets sets(look.mesh.triangles.size());
  for (const SharedEdge& e : look.edges)
    if (e.right >= 0 && same(e)) sets.join(e.left, e.right);
  std::map<std::int32_t, std::size_t> number;
  std::vector<Region> found;
  std::vector<std::size_t> region_of;
  for (std::size_t i = 0; i < look.mesh.triangles.size(); ++i) {
    const auto [at, is_new] = number.emplace(sets.find(static_cast<std::int32_t>(i)), found.size());
    if (is_new) found.emplace_back();
    found[at->second].triangles.push_back(static_cast<std::int32_t>(i));
    region_of.push_back(at->second);
  }
  for (std::size_t k = 0; k < look.edges.size(); ++k) {
    const SharedEdge& e = look.edges[k];
    const std::size_t left = region_of[static_cast<std::size_t>(e.left)];
    if (e.right < 0) {
      found[left].on_border = true;
      continue;
    }
    const std::size_t right = region_of[static_cast<std::size_t>(e.right)];
    if (left == right) continue;
    found[left].rim.push_back(k);
    found[right].rim.push_back(k);
  }
  return found;
}

void measure(const Look& look, Region& region) {
  const TriMesh& mesh = look.mesh;
  Vec3 sum = Vec3::Zero(), centre = Vec3::Zero();
  for (const std::int32_t t : region.triangles) {
    sum += 0.5 * doubled_area(mesh, t);
    region.area_mm2 += 0.5 * doubled_area(mesh, t).norm();
  }
  region.end.normal = sum.normalized();
  region.flat_area_mm2 = sum.norm();
  for (const std::size_t k : region.rim) {
    const SharedEdge& e = look.edges[k];
    const Vec3 &a = mesh.points[static_cast<std::size_t>(e.a)],
               &b = mesh.points[static_cast<std::size_t>(e.b)];
    const double length = (b - a).norm();
    region.rim_mm += length;
    region.rim_deg += length * look.angle_deg(e);
    centre += length * 0.5 * (a + b);
  }
  if (!(region.rim_mm > 0.0)) return;
  region.rim_deg /= region.rim_mm;
  region.end.centre = centre / region.rim_mm;
  region.end.radius_mm = std::sqrt(region.area_mm2 / std::numbers::pi);
  for (const std::int32_t t : region.triangles)
    for (const std::int32_t v : mesh.triangles[static_cast<std::size_t>(t)])
      region.deviation_mm = std::max(
          region.deviation_mm,
          std::abs((mesh.points[static_cast<std::size_t>(v)] - region.end.centre).dot(region.end.normal)));
  region.one_loop = is_one_loop(look, region.rim);
}

bool is_flat(const Region& region, const FlatCapOptions& o) {
  const double roundness = 4.0 * std::numbers::pi * region.area_mm2 / (region.rim_mm * region.rim_mm);
  return !region.on_border && region.one_loop && region.rim.size() >= fewest_on_rim &&
         roundness >= o.least_roundness && region.deviation_mm <= o.flat_tolerance * region.end.radius_mm;
}

bool is_as_wide_as_lumen(const geometry::AabbTree& tree, const GivenEnd& end) {
  return std::ranges::all_of(depths_radii, [&](double depth) {
    const double behind = lumen_width_behind(tree, end, depth);
    return end.radius_mm >= narrowest_cap * behind && end.radius_mm <= widest_cap * behind;
  });
}

}  // namespace ostia::meshing
