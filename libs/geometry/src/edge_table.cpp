#include "edge_table.h"

#include "mesh_checks.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace ostia::geometry::detail {

namespace {

/// Where those of each vertex begin, and the end; in `counts` before: how many each has, one place on.
std::vector<std::uint32_t> starts_of(std::vector<std::uint32_t> counts) {
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
  return counts;
}

}  // namespace

std::vector<HalfEdge> half_edges(const TriMesh& mesh) {
  // Counting sorts that keep the order of equals, by the higher vertex and then by the lower one: no
  // comparison, and so no branch that a processor has to guess.
  std::vector<std::uint32_t> highs(mesh.points.size() + 1, 0), lows(mesh.points.size() + 1, 0);
  const auto for_each_side = [&](const auto& use) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& triangle = mesh.triangles[t];
      if (repeats_a_corner(triangle)) continue;
      for (std::size_t side = 0; side < 3; ++side) use(t, side, triangle[side], triangle[(side + 1) % 3]);
    }
  };
  for_each_side([&](std::size_t, std::size_t, std::int32_t a, std::int32_t b) {
    ++lows[static_cast<std::size_t>(std::min(a, b)) + 1];
    ++highs[static_cast<std::size_t>(std::max(a, b)) + 1];
  });
  lows = starts_of(std::move(lows));
  highs = starts_of(std::move(highs));
  std::vector<HalfEdge> by_high(highs.back()), table(highs.back());
  for_each_side([&](std::size_t t, std::size_t side, std::int32_t a, std::int32_t b) {
    by_high[highs[static_cast<std::size_t>(std::max(a, b))]++] = {
        std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), static_cast<std::int8_t>(side), a < b};
  });
  for (const HalfEdge& edge : by_high) table[lows[static_cast<std::size_t>(edge.low)]++] = edge;
  return table;
}

std::vector<CornersOfTriangle> sorted_corners(const TriMesh& mesh) {
  std::vector<std::uint32_t> next(mesh.points.size() + 1, 0);
  for (const Triangle& t : mesh.triangles) ++next[static_cast<std::size_t>(std::ranges::min(t)) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<CornersOfTriangle> sorted(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    CornersOfTriangle one{mesh.triangles[t], static_cast<std::int32_t>(t)};
    std::ranges::sort(one.corners);
    sorted[next[static_cast<std::size_t>(one.corners[0])]++] = one;
  }
  for (std::size_t v = 0, first = 0; v + 1 < next.size(); first = next[v++])
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
              sorted.begin() + static_cast<std::ptrdiff_t>(next[v]));
  return sorted;
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
