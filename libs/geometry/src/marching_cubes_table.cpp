#include "ostia/core/error.h"
#include "ostia/geometry/cube_patterns.h"

#include <algorithm>

namespace ostia::geometry {
namespace {

using Loop = std::vector<std::uint8_t>;

std::array<CubeEdge, 12> make_edges() {
  std::array<CubeEdge, 12> edges{};
  for (int axis = 0; axis < 3; ++axis) {
    const int p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2;
    for (int b = 0; b < 4; ++b) {
      const int from = ((b & 1) << p) | ((b >> 1) << q);
      edges[static_cast<std::size_t>(4 * axis + b)] = {from, from | (1 << axis), axis};
    }
  }
  return edges;
}

int edge_between(int a, int b) {
  const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
  const int p = axis == 0 ? 1 : 0, q = axis == 2 ? 1 : 2;
  return 4 * axis + (((a >> p) & 1) | (((a >> q) & 1) << 1));
}

// The four corners of a face, counter-clockwise seen from outside the cube.
std::array<int, 4> face_corners(int axis, int side) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int base = side << axis;
  std::array<int, 4> corners{base, base | (1 << u), base | (1 << u) | (1 << v), base | (1 << v)};
  if (side == 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

bool inside(int pattern, int corner) {
  return ((pattern >> corner) & 1) != 0;
}

// For each crossed edge the one that follows it around the surface within a face. Going around a face
// counter-clockwise, the run of inside corners is entered at one crossing and left at another; the segment
// joins just these two. A face with two inside corners at a diagonal has two runs: inside corners are always
// separated there. That depends on the face's own corners alone, so the two cubes at a face draw the same
// segments, in opposite directions.
std::array<int, 12> successors(int pattern) {
  std::array<int, 12> next{};
  next.fill(-1);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const std::array<int, 4> c = face_corners(axis, side);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!inside(pattern, c[(i + 1) % 4]) || inside(pattern, c[i])) continue;
        std::size_t last = (i + 1) % 4;
        while (inside(pattern, c[(last + 1) % 4])) last = (last + 1) % 4;
        next[static_cast<std::size_t>(edge_between(c[i], c[(i + 1) % 4]))] =
            edge_between(c[last], c[(last + 1) % 4]);
      }
    }
  }
  return next;
}

std::vector<Loop> loops_of(int pattern) {
  const std::array<int, 12> next = successors(pattern);
  std::array<bool, 12> seen{};
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < 12; ++start) {
    if (next[start] < 0 || seen[start]) continue;
    Loop loop;
    for (std::size_t e = start; !seen[e]; e = static_cast<std::size_t>(next[e])) {
      seen[e] = true;
      loop.push_back(static_cast<std::uint8_t>(e));
    }
    loops.push_back(loop);
  }
  return loops;
}

bool share_a_face(int edge_a, int edge_b) {
  const CubeEdge& a = cube_edges()[static_cast<std::size_t>(edge_a)];
  const CubeEdge& b = cube_edges()[static_cast<std::size_t>(edge_b)];
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == a.axis || axis == b.axis) continue;
    if (((a.from >> axis) & 1) == ((b.from >> axis) & 1)) return true;
  }
  return false;
}

// Triangulates loop[first..last] with the chord first-last given; false when it takes a chord inside a face
// of the cube. Such a chord could meet the neighbour's, and four triangles would share it.
bool triangulate(const Loop& loop, std::size_t first, std::size_t last, CubePattern& triangles) {
  if (last - first < 2) return true;
  const std::size_t kept = triangles.size();
  const auto chord_is_free = [&](std::size_t i, std::size_t j) {
    return j - i == 1 || !share_a_face(loop[i], loop[j]);
  };
  // Near the middle first: fans make longer chords.
  std::vector<std::size_t> order;
  for (std::size_t i = first + 1; i < last; ++i) order.push_back(i);
  const std::size_t middle = (first + last) / 2;
  const auto off = [&](std::size_t i) { return i > middle ? i - middle : middle - i; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return off(i) < off(j); });
  for (const std::size_t i : order) {
    if (!chord_is_free(first, i) || !chord_is_free(i, last)) continue;
    triangles.push_back({loop[first], loop[i], loop[last]});
    if (triangulate(loop, first, i, triangles) && triangulate(loop, i, last, triangles)) return true;
    triangles.resize(kept);
  }
  return false;
}

// All triangles from one corner of the loop, the first from which no chord lies in a face; false where there
// is none.
bool fan(const Loop& loop, CubePattern& triangles) {
  const std::size_t n = loop.size();
  for (std::size_t apex = 0; apex < n; ++apex) {
    bool is_free = true;
    for (std::size_t i = 2; i + 1 < n; ++i) is_free &= !share_a_face(loop[apex], loop[(apex + i) % n]);
    if (!is_free) continue;
    for (std::size_t i = 1; i + 1 < n; ++i)
      triangles.push_back({loop[apex], loop[(apex + i) % n], loop[(apex + i + 1) % n]});
    return true;
  }
  return false;
}

// Loops of seven are so bent that some of their triangulations cross themselves where the surface passes near
// the cube's corners; fans never do, and up to six no triangulation does.
constexpr std::size_t longest_free_loop = 6;

CubePattern make_pattern(int pattern) {
  CubePattern triangles;
  for (const Loop& loop : loops_of(pattern)) {
    // Each of the 256 patterns has such a triangulation, so no loop needs a point of its own.
    const bool done = loop.size() > longest_free_loop ? fan(loop, triangles)
                                                      : triangulate(loop, 0, loop.size() - 1, triangles);
    if (!done) throw Error("a cube's loop cannot be triangulated");
  }
  return triangles;
}

}  // namespace

const std::array<CubeEdge, 12>& cube_edges() {
  static const std::array<CubeEdge, 12> edges = make_edges();
  return edges;
}

const std::array<CubePattern, 256>& cube_patterns() {
  static const std::array<CubePattern, 256> patterns = [] {
    std::array<CubePattern, 256> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = make_pattern(static_cast<int>(i));
    return all;
  }();
  return patterns;
}

}  // namespace ostia::geometry
