#include "edge_table.h"

#include "mesh_checks.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace ostia::geometry::detail {

std::vector<HalfEdge> half_edges(const TriMesh& mesh) {
  // Counting sort by the lower vertex, then a small sort within each vertex.
  std::vector<std::size_t> start(mesh.points.size() + 1, 0);
  const auto for_each_side = [&](const auto& use) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& triangle = mesh.triangles[t];
      if (repeats_a_corner(triangle)) continue;
      for (std::size_t side = 0; side < 3; ++side) {
        const std::int32_t a = triangle[side], b = triangle[(side + 1) % 3];
        use(HalfEdge{std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t),
                     static_cast<std::int8_t>(side), a < b});
      }
    }
  };
  for_each_side([&](const HalfEdge& h) { ++start[static_cast<std::size_t>(h.low) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<HalfEdge> table(start.back());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_each_side([&](const HalfEdge& h) { table[next[static_cast<std::size_t>(h.low)]++] = h; });
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    std::sort(table.begin() + static_cast<std::ptrdiff_t>(start[v]),
              table.begin() + static_cast<std::ptrdiff_t>(start[v + 1]),
              [](const HalfEdge& a, const HalfEdge& b) {
                return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
              });
  }
  return table;
}

std::vector<std::int32_t> first_equal_points(const std::vector<Vec3>& points) {
  // Open addressing over a table of twice the size: several times quicker than the standard map.
  const std::size_t capacity = std::bit_ceil(2 * points.size() + 1);
  std::vector<std::int32_t> slots(capacity, -1);
  std::vector<std::int32_t> first(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto own = static_cast<std::int32_t>(i);
    first[i] = own;
    if (!points[i].allFinite()) continue;
    std::uint64_t hash = 0;
    for (int a = 0; a < 3; ++a) {
      hash =
          (hash ^ std::bit_cast<std::uint64_t>(points[i][a] + 0.0)) * 0x9E3779B97F4A7C15ULL;  // -0 + 0 is +0
      hash ^= hash >> 29;
    }
    std::size_t slot = hash & (capacity - 1);
    while (slots[slot] >= 0 && points[static_cast<std::size_t>(slots[slot])] != points[i]) {
      slot = (slot + 1) & (capacity - 1);
    }
    if (slots[slot] < 0) slots[slot] = own;
    first[i] = slots[slot];
  }
  return first;
}

}  // namespace ostia::geometry::detail
