#include "ostia/geometry/moving_surface.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ostia::geometry {
namespace {

TriMesh tube() {
  return structured_surface(straight_tube(40.0, 2.0).tubes[0], 32, 0.4);
}

std::vector<Vec3> bent(std::vector<Vec3> points) {
  for (Vec3& p : points) p.x() += 6.0 * std::sin(p.z() / 8.0);
  return points;
}

TEST(MovingSurface, FindsWhatANewTreeFindsWhereverItStarts) {
  TriMesh mesh = tube();
  MovingSurface moving(mesh);
  mesh.points = bent(mesh.points);
  moving.move(mesh.points);
  const AabbTree tree(mesh);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto triangles = static_cast<std::int32_t>(mesh.triangles.size());
  for (int k = 0; k < 500; ++k) {
    const Vec3 query(12.0 * unit(random), 6.0 * unit(random), 20.0 + 25.0 * unit(random));
    const SurfacePoint known = tree.closest(query);
    for (const std::int32_t near : {-1, 0, 37 * k % triangles, known.triangle, triangles}) {
      const SurfacePoint found = moving.closest(query, near);
      EXPECT_NEAR(found.distance, known.distance, 1e-12);
      EXPECT_NEAR((query - found.point).norm(), found.distance, 1e-12);
      ASSERT_GE(found.triangle, 0);
    }
  }
}

// A straight tube along z about the origin: its facets lie between cos(pi / 32) of the radius and the radius.
TEST(MovingSurface, KnowsTheDistanceOfATube) {
  TriMesh mesh = tube();
  MovingSurface moving(mesh);
  for (Vec3& p : mesh.points) p.x() += 100.0;
  moving.move(mesh.points);
  const double found = moving.closest({105.0, 0.0, 20.0}).distance;
  EXPECT_GE(found, 3.0 - 1e-9);
  EXPECT_LE(found, 5.0 - 2.0 * std::cos(std::acos(-1.0) / 32.0));
}

TEST(MovingSurface, RefusesWhatIsNoSurface) {
  EXPECT_THROW(MovingSurface(TriMesh{}), InvalidInput);
  TriMesh mesh = tube();
  MovingSurface moving(mesh);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(moving.closest({nan, 0.0, 0.0}), InvalidInput);
  mesh.points.back().x() = nan;
  EXPECT_THROW(moving.move(mesh.points), InvalidInput);
  EXPECT_THROW(MovingSurface{mesh}, InvalidInput);
  mesh.points.pop_back();
  EXPECT_THROW(moving.move(mesh.points), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
