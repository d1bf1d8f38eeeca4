#include "ray_scene.h"

#include "test_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

TEST(RayScene, MeetsABallWhereGeometrySays) {
  Scene scene;
  scene.meshes.push_back({.mesh = ball(5.0, 200, {300, -200, 700})});
  const RayScene rays(scene, {300, -200, 700});
  const auto hit = rays.first_hit(RayScene::Part::opaque, {{3.0, -20.0, 0.0}, Vec3::UnitY()}, 0.0, 1e9);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 16.0, 2e-3);
  EXPECT_GT(hit->normal.dot(Vec3(3, -4, 0) / 5.0), 0.999);
  EXPECT_GT(rays.shading_normal(*hit).dot(Vec3(3, -4, 0) / 5.0), 0.9999);
  EXPECT_FALSE(rays.first_hit(RayScene::Part::opaque, {{5.1, -20.0, 0.0}, Vec3::UnitY()}, 0.0, 1e9));
  EXPECT_FALSE(rays.first_hit(RayScene::Part::opaque, {{3.0, -20.0, 0.0}, Vec3::UnitY()}, 0.0, 15.0));
  EXPECT_TRUE(rays.occluded({{0, 0, 0}, Vec3::UnitX()}, 0.0, 6.0));
  EXPECT_FALSE(rays.occluded({{0, 0, 0}, Vec3::UnitX()}, 0.0, 4.0));
}

TEST(RayScene, TubesAreRoundAndTaperLinearly) {
  Scene scene;
  scene.tubes.push_back({.points = {{0, 0, 0}, {0, 0, 10}, {0, 0, 20}}, .radius_mm = {1.0, 2.0, 3.0}});
  scene.tubes.push_back({.points = {{30, 0, 0}}, .radius_mm = {4.0}});
  const RayScene rays(scene, Vec3::Zero());
  // A cone-sphere touches the spheres of its ends: its radius at z is a little more than linear.
  const double slant = std::sqrt(1.0 - 0.1 * 0.1);
  for (const double z : {4.0, 9.0, 14.0}) {
    const auto hit = rays.first_hit(RayScene::Part::opaque, {{0, -10, z}, Vec3::UnitY()}, 0.0, 1e9);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(hit->tube);
    EXPECT_NEAR(10.0 - hit->t, (1.0 + 0.1 * z) / slant, 2e-3) << z;
  }
  const auto end = rays.first_hit(RayScene::Part::opaque, {{30, 0, 20}, -Vec3::UnitZ()}, 0.0, 1e9);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->actor, 1U);
  EXPECT_NEAR(end->t, 16.0, 1e-4);
}

TEST(RayScene, KeepsOpaqueAndTransparentApart) {
  Scene scene;
  scene.meshes.push_back({.mesh = sheet(5, 5, 0.0), .color = {1, 0, 0, 0.5}});
  const RayScene rays(scene, Vec3::Zero());
  EXPECT_TRUE(rays.has_transparent());
  EXPECT_TRUE(rays.first_hit(RayScene::Part::transparent, {{1, -5, 1}, Vec3::UnitY()}, 0.0, 1e9));
  EXPECT_FALSE(rays.first_hit(RayScene::Part::opaque, {{1, -5, 1}, Vec3::UnitY()}, 0.0, 1e9));
  EXPECT_FALSE(rays.occluded({{1, -5, 1}, Vec3::UnitY()}, 0.0, 1e9));
}

TEST(CornerNormals, RoundOffSmallBendsAndKeepCreases) {
  geometry::TriMesh roof;  // two sheets that meet at 90 degrees along the z axis
  roof.points = {{0, 0, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 1, 0}};
  roof.triangles = {{0, 2, 1}, {0, 1, 3}};
  const Vec3 first = (roof.points[2] - roof.points[0]).cross(roof.points[1] - roof.points[0]).normalized();
  const auto sharp = corner_normals(roof, 40.0);
  EXPECT_GT(sharp[0][0].cast<double>().dot(first), 0.9999);
  const auto round = corner_normals(roof, 100.0);
  EXPECT_NEAR(round[0][0].cast<double>().dot(first), std::sqrt(0.5), 1e-5);
  EXPECT_GT(round[0][1].cast<double>().dot(first), 0.9999);  // the corner that is not shared
}

}  // namespace
}  // namespace ostia::figure
