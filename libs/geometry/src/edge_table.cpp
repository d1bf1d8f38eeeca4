#include "edge_table.h"

#include "mesh_checks.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

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

namespace {

constexpr std::size_t parts = 32, edge_grain = 1 << 16;

std::uint64_t hash_of(const Vec3& point) {
  std::uint64_t hash = 0;
  for (int a = 0; a < 3; ++a) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(point[a] + 0.0)) * 0x9E3779B97F4A7C15ULL;  // -0 + 0 is +0
    hash ^= hash >> 29;
  }
  return hash;
}

/// Points of equal hashes, ascending.
struct PointParts {
  std::vector<std::int32_t> points;
  std::vector<std::size_t> first;  ///< of each part; and the end
};

PointParts parted(const std::vector<std::uint32_t>& hashes) {
  const std::size_t chunks = (hashes.size() + edge_grain - 1) / edge_grain;
  std::vector<std::array<std::size_t, parts>> next(chunks);
  core::parallel_chunks(hashes.size(), edge_grain, [&](std::size_t begin, std::size_t end) {
    auto& counts = next[begin / edge_grain];
    counts.fill(0);
    for (std::size_t i = begin; i < end; ++i) ++counts[hashes[i] % parts];
  });
  PointParts sorted;
  std::size_t sum = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    sorted.first.push_back(sum);
    for (auto& counts : next) sum += std::exchange(counts[part], sum);
  }
  sorted.first.push_back(sum);
  sorted.points.resize(sum);
  core::parallel_chunks(hashes.size(), edge_grain, [&](std::size_t begin, std::size_t end) {
    auto& at = next[begin / edge_grain];
    for (std::size_t i = begin; i < end; ++i)
      sorted.points[at[hashes[i] % parts]++] = static_cast<std::int32_t>(i);
  });
  return sorted;
}

/// Among points that are equal only to each other. Open addressing over a table of twice the size: several
/// times quicker than the standard map.
void find_first(const std::vector<Vec3>& points, const std::int32_t* begin, const std::int32_t* end,
                const std::vector<std::uint32_t>& hashes, std::vector<std::int32_t>& first) {
  const std::size_t capacity = std::bit_ceil(2 * static_cast<std::size_t>(end - begin) + 1);
  std::vector<std::int32_t> slots(capacity, -1);
  for (; begin != end; ++begin) {
    const auto own = static_cast<std::size_t>(*begin);
    first[own] = *begin;
    if (!points[own].allFinite()) continue;
    std::size_t slot = hashes[own] / parts & (capacity - 1);
    while (slots[slot] >= 0 && points[static_cast<std::size_t>(slots[slot])] != points[own])
      slot = (slot + 1) & (capacity - 1);
    if (slots[slot] < 0) slots[slot] = *begin;
    first[own] = slots[slot];
  }
}

}  // namespace

std::vector<std::int32_t> first_equal_points(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> hashes(points.size());
  core::parallel_for(points.size(), edge_grain,
                     [&](std::size_t i) { hashes[i] = static_cast<std::uint32_t>(hash_of(points[i])); });
  const PointParts sorted = parted(hashes);
  std::vector<std::int32_t> first(points.size());
  core::parallel_for(parts, 1, [&](std::size_t part) {
    find_first(points, sorted.points.data() + sorted.first[part],
               sorted.points.data() + sorted.first[part + 1], hashes, first);
  });
  return first;
}

}  // namespace ostia::geometry::detail
