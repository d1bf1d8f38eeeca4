#include "mesh_export_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mixed_mesh_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace ostia::io {
namespace {

using geometry::MixedMesh;
using geometry::Prism;
using Side = std::array<std::int32_t, 3>;

double volume(const MixedMesh& mesh, const geometry::Tetrahedron& t) {
  const auto p = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
  return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0;
}

/// Sides of tetrahedra, sorted corners, that occur once.
std::set<Side> free_sides(const MixedMesh& mesh) {
  std::set<Side> once;
  for (const auto& t : mesh.tetrahedra) {
    for (const Side& side :
         {Side{t[0], t[1], t[2]}, Side{t[0], t[1], t[3]}, Side{t[1], t[2], t[3]}, Side{t[0], t[2], t[3]}}) {
      Side key = side;
      std::ranges::sort(key);
      if (const auto [place, added] = once.insert(key); !added) once.erase(place);
    }
  }
  return once;
}

std::set<Side> boundary(const MixedMesh& mesh) {
  std::set<Side> sides;
  for (Side key : mesh.triangles) {
    std::ranges::sort(key);
    sides.insert(key);
  }
  return sides;
}

TEST(SplitPrisms, CutsOnePrismWhateverTheOrderOfItsIndices) {
  const std::vector<geometry::Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                               {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  std::array<std::int32_t, 6> order{};
  std::iota(order.begin(), order.end(), 0);
  do {
    MixedMesh mesh;
    mesh.points.resize(6);
    Prism prism{};
    for (std::size_t i = 0; i < 6; ++i) {
      mesh.points[static_cast<std::size_t>(order[i])] = corners[i];
      prism[i] = order[i];
    }
    mesh.prisms = {prism};
    const MixedMesh split = geometry::split_prisms(mesh);
    ASSERT_EQ(split.tetrahedra.size(), 3u);
    EXPECT_TRUE(split.prisms.empty());
    for (const auto& t : split.tetrahedra) EXPECT_NEAR(volume(split, t), 1.0 / 6.0, 1e-15);
    const std::set<Side> outside = free_sides(split);
    EXPECT_EQ(outside.size(), 8u);
    for (const std::array<int, 4>& quad :
         {std::array{0, 1, 4, 3}, std::array{1, 2, 5, 4}, std::array{2, 0, 3, 5}}) {
      for (Side side :
           geometry::split_quad({prism[quad[0]], prism[quad[1]], prism[quad[2]], prism[quad[3]]})) {
        std::ranges::sort(side);
        EXPECT_TRUE(outside.contains(side)) << "the quadrilateral is cut along its other diagonal";
      }
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(SplitPrisms, FitsNeighboursAndBoundaryTogether) {
  const MixedMesh mesh = column_with_prisms(), split = geometry::split_prisms(mesh);
  EXPECT_EQ(split.tetrahedra.size(), mesh.tetrahedra.size() + 3 * mesh.prisms.size());
  EXPECT_EQ(split.triangles.size(), mesh.triangles.size() + 2 * mesh.quads.size());
  EXPECT_EQ(split.triangle_face_ids.size(), split.triangles.size());
  EXPECT_EQ(free_sides(split), boundary(split));
  double sum = 0.0;
  for (const auto& t : split.tetrahedra) {
    EXPECT_GT(volume(split, t), 0.0);
    sum += volume(split, t);
  }
  EXPECT_NEAR(sum, measure(mesh).volume, 1e-10);
  const MeshMeasure before = measure(mesh), after = measure(split);
  for (const auto& [name, face] : before.faces) {
    EXPECT_NEAR(after.faces.at(name).area, face.area, 1e-12) << name;
    EXPECT_LE((after.faces.at(name).vector_area - face.vector_area).norm(), 1e-12) << name;
  }
}

TEST(SplitPrisms, KeepsTheNodesOfTheSecondOrder) {
  const MixedMesh mesh = quadratic(column_with_prisms()), split = geometry::split_prisms(mesh);
  EXPECT_EQ(split.points, mesh.points);
  EXPECT_EQ(split.tetrahedron_nodes.size(), split.tetrahedra.size());
  EXPECT_EQ(split.triangle_nodes.size(), split.triangles.size());
  // Each edge has one node, whichever element or triangle says so.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> node_of;
  const auto expect_node = [&](std::int32_t a, std::int32_t b, std::int32_t node) {
    EXPECT_EQ(node_of.try_emplace(std::minmax(a, b), node).first->second, node) << a << ' ' << b;
  };
  constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t i = 0; i < split.tetrahedra.size(); ++i) {
    for (std::size_t e = 0; e < 6; ++e)
      expect_node(split.tetrahedra[i][edges[e][0]], split.tetrahedra[i][edges[e][1]],
                  split.tetrahedron_nodes[i][e]);
  }
  for (std::size_t i = 0; i < split.triangles.size(); ++i) {
    for (std::size_t e = 0; e < 3; ++e)
      expect_node(split.triangles[i][edges[e][0]], split.triangles[i][edges[e][1]],
                  split.triangle_nodes[i][e]);
  }
}

}  // namespace
}  // namespace ostia::io
