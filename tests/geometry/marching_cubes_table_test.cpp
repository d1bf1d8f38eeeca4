#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/cube_patterns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

namespace ostia::geometry {
namespace {

bool on_a_common_face(int edge_a, int edge_b) {
  const CubeEdge& a = cube_edges()[static_cast<std::size_t>(edge_a)];
  const CubeEdge& b = cube_edges()[static_cast<std::size_t>(edge_b)];
  for (int axis = 0; axis < 3; ++axis) {
    const std::set<int> sides{(a.from >> axis) & 1, (a.to >> axis) & 1, (b.from >> axis) & 1,
                              (b.to >> axis) & 1};
    if (sides.size() == 1) return true;
  }
  return false;
}

TEST(MarchingCubesTable, EdgesJoinNeighbouringCorners) {
  std::set<std::pair<int, int>> seen;
  for (const CubeEdge& e : cube_edges()) {
    EXPECT_EQ(e.from ^ e.to, 1 << e.axis);
    EXPECT_LT(e.from, e.to);
    seen.insert({e.from, e.to});
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST(MarchingCubesTable, EachPatternUsesJustTheCrossedEdges) {
  for (std::size_t pattern = 0; pattern < 256; ++pattern) {
    std::set<int> crossed, used;
    for (std::size_t e = 0; e < 12; ++e) {
      const CubeEdge& edge = cube_edges()[e];
      if (((pattern >> edge.from) & 1u) != ((pattern >> edge.to) & 1u)) crossed.insert(static_cast<int>(e));
    }
    for (const auto& t : cube_patterns()[pattern]) used.insert(t.begin(), t.end());
    EXPECT_EQ(crossed, used) << "pattern " << pattern;
    EXPECT_LE(cube_patterns()[pattern].size(), 5u);
  }
}

TEST(MarchingCubesTable, InnerEdgesPairUpAndLieInNoFace) {
  for (std::size_t pattern = 0; pattern < 256; ++pattern) {
    std::map<std::pair<int, int>, int> half_edges;
    for (const auto& t : cube_patterns()[pattern]) {
      for (std::size_t c = 0; c < 3; ++c) ++half_edges[{t[c], t[(c + 1) % 3]}];
    }
    for (const auto& [edge, count] : half_edges) {
      EXPECT_EQ(count, 1);
      const bool inner = half_edges.count({edge.second, edge.first}) > 0;
      EXPECT_NE(inner, on_a_common_face(edge.first, edge.second)) << "pattern " << pattern;
    }
  }
}

TEST(MarchingCubesTable, NoPatternCrossesItselfWhereverTheCrossingsLie) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t pattern = 1; pattern < 255; ++pattern) {
    for (int trial = 0; trial < 300; ++trial) {
      TriMesh mesh;
      for (const CubeEdge& edge : cube_edges()) {
        double at = unit(random);  // anywhere, at one end or the other, near an end
        if (trial % 3 == 1) at = at < 0.5 ? 1e-3 : 1.0 - 1e-3;
        if (trial % 3 == 2) at = std::clamp(at * at * at, 1e-3, 1.0 - 1e-3);
        Vec3 p(edge.from & 1, (edge.from >> 1) & 1, (edge.from >> 2) & 1);
        p[edge.axis] += at;
        mesh.points.push_back(p);
      }
      for (const auto& t : cube_patterns()[pattern]) mesh.triangles.push_back({t[0], t[1], t[2]});
      ASSERT_TRUE(self_intersections(mesh, 1).empty()) << "pattern " << pattern;
    }
  }
}

}  // namespace
}  // namespace ostia::geometry
