// The changes of connectivity one by one.
#include "tetrahedra/cavity.h"
#include "tetrahedra/flips.h"
#include "tetrahedra/quality.h"
#include "tetrahedra_samples.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using Id = TetrahedraComplex::Id;
using geometry::VolumeMesh;

/// A regular octahedron around its axis 5-4, with one more point on the axis near its upper end.
VolumeMesh octahedron_with_a_short_edge() {
  VolumeMesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 0.9}};
  for (std::int32_t i = 0; i < 4; ++i) {
    mesh.tetrahedra.push_back({6, 4, i, (i + 1) % 4});
    mesh.tetrahedra.push_back({5, 6, i, (i + 1) % 4});
  }
  take_boundary(mesh);
  return mesh;
}

TEST(TetrahedraComplex, KnowsNeighboursStarsAndRings) {
  const VolumeMesh mesh = octahedron_with_a_short_edge();
  TetrahedraComplex complex(mesh);
  EXPECT_EQ(complex.alive_count(), 8u);
  for (Id t = 0; t < 8; ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      const Id n = complex.neighbour(t, f);
      if (n == TetrahedraComplex::none) continue;
      EXPECT_EQ(complex.corner_of(n, complex.corners(t)[f]), 4u);
      for (const Id v : complex.face(t, f)) EXPECT_LT(complex.corner_of(n, v), 4u);
    }
  std::vector<Id> star, around;
  complex.star(6, star);
  EXPECT_EQ(star.size(), 8u);
  complex.star(4, star);
  EXPECT_EQ(star.size(), 4u);
  ASSERT_TRUE(complex.ring(0, 6, 4, 10, star, around));
  EXPECT_EQ(around, (std::vector<Id>{0, 1, 2, 3}));
  EXPECT_FALSE(complex.ring(0, 6, 4, 3, star, around));   // more than asked for
  EXPECT_FALSE(complex.ring(0, 4, 0, 10, star, around));  // of the boundary
  EXPECT_TRUE(complex.fixed(0));
  EXPECT_FALSE(complex.fixed(6));
}

TEST(TetrahedraComplex, RefusesAnExchangeThatDoesNotFillTheCavity) {
  TetrahedraComplex complex(octahedron_with_a_short_edge());
  EXPECT_THROW(complex.replace({0, 1}, {{6, 4, 0, 2}}), GeometryError);
}

TEST(TetrahedraCavity, DrawsAPointOverAShortEdge) {
  const VolumeMesh old = octahedron_with_a_short_edge();
  TetrahedraComplex complex(old);
  ASSERT_TRUE(TetrahedraCavity(complex).contract(0));
  VolumeMesh mesh = old;
  complex.write_to(mesh);
  EXPECT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.tetrahedra.size(), 4u);
  expect_sound(mesh, old);
  const std::vector<Id> left = complex.touched();
  ASSERT_FALSE(left.empty());
  for (const Id t : left) EXPECT_FALSE(TetrahedraCavity(complex).contract(t));  // no inner point is left
}

TEST(TetrahedraCavity, AddsAPointWhereAFlatTetrahedronLies) {
  const VolumeMesh old = flat_tetrahedron_under_a_roof();
  TetrahedraComplex complex(old);
  const double before = complex.quality(0);
  ASSERT_TRUE(TetrahedraCavity(complex).insert(0));
  VolumeMesh mesh = old;
  complex.write_to(mesh);
  EXPECT_EQ(mesh.points.size(), old.points.size() + 1);
  expect_sound(mesh, old);
  for (const Id t : complex.touched()) EXPECT_GT(complex.quality(t), before + 1e-3);
  // Not nearer to the others than a third of their distances.
  for (std::size_t i = 0; i < old.points.size(); ++i)
    EXPECT_GT((mesh.points.back() - mesh.points[i]).norm(), 0.35);
}

/// Two flat pyramids on a regular pentagon, cut into three tetrahedra above and three below.
VolumeMesh pentagons() {
  VolumeMesh mesh;
  for (int i = 0; i < 5; ++i) {
    const double angle = 0.4 * std::numbers::pi * i;
    mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  mesh.points.emplace_back(0, 0, 0.3);
  mesh.points.emplace_back(0, 0, -0.3);
  for (std::int32_t i = 1; i < 4; ++i) mesh.tetrahedra.push_back({0, i, i + 1, 5});
  for (std::int32_t i = 1; i < 4; ++i) mesh.tetrahedra.push_back({0, i + 1, i, 6});
  take_boundary(mesh);
  return mesh;
}

TEST(TetrahedraFlips, RemovesAllFacesBetweenTwoPointsAndTheEdgeInPlaceOfThem) {
  // The axis 5-6 goes through the middle triangle only: it alone cannot be removed.
  const VolumeMesh old = pentagons();
  TetrahedraComplex complex(old);
  TetrahedraFlips flips(complex);
  EXPECT_FALSE(flips.remove_face(1, 0));  // of the boundary
  ASSERT_TRUE(flips.remove_face(1, 3));
  VolumeMesh mesh = old;
  complex.write_to(mesh);
  expect_sound(mesh, old);
  EXPECT_EQ(mesh.tetrahedra.size(), 5u);
  for (const auto& t : mesh.tetrahedra) {
    EXPECT_NE(std::find(t.begin(), t.end(), 5), t.end());
    EXPECT_NE(std::find(t.begin(), t.end(), 6), t.end());
  }
  // The way back would be worse, and is refused.
  EXPECT_FALSE(flips.remove_edge(complex.touched().front(), 5, 6));
}

TEST(TetrahedraFlips, TriangulatesTheRingOfALongEdgeBest) {
  // Along a long axis the pentagon's three tetrahedra above and below are better than five around it.
  VolumeMesh old = pentagons();
  old.points[5].z() = 4.0;
  old.points[6].z() = -4.0;
  old.tetrahedra.clear();
  for (std::int32_t i = 0; i < 5; ++i) old.tetrahedra.push_back({6, 5, i, (i + 1) % 5});
  TetrahedraComplex complex(old);
  ASSERT_TRUE(TetrahedraFlips(complex).remove_edge(0, 5, 6));
  VolumeMesh mesh = old;
  complex.write_to(mesh);
  expect_sound(mesh, old);
  EXPECT_EQ(mesh.tetrahedra.size(), 6u);
}

}  // namespace
}  // namespace ostia::meshing
