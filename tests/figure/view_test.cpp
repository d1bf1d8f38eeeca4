#include "test_shapes.h"

#include "ostia/core/error.h"
#include "ostia/figure/scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

Scene scene_of(geometry::TriMesh mesh) {
  Scene scene;
  scene.meshes.push_back({.mesh = std::move(mesh)});
  return scene;
}

TEST(View, FitsEverythingWithinTheMarginTightly) {
  const Scene scene = scene_of(ball(7.0, 24, {100, -40, 30}));
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    Camera camera = cameras::angiographic(30, 20);
    camera.projection = projection;
    camera.margin = 0.1;
    const View view = fitted_view(scene, camera, 400, 300);
    Vec2 low(1e9, 1e9);
    Vec2 high = -low;
    for (const Vec3& p : scene.meshes[0].mesh.points) {
      low = low.cwiseMin(view.project(p));
      high = high.cwiseMax(view.project(p));
    }
    EXPECT_NEAR(low.y(), 30.0, 1.0);
    EXPECT_NEAR(high.y(), 270.0, 1.0);
    EXPECT_NEAR(low.x() + high.x(), 400.0, 2.0);
  }
}

TEST(View, FromTheFrontThePatientsLeftIsOnTheRightAndTheHeadUp) {
  const View view = fitted_view(scene_of(ball(5.0, 8)), cameras::anterior(), 200, 200);
  EXPECT_GT(view.project({3, 0, 0}).x(), 100.0);
  EXPECT_LT(view.project({0, 0, 3}).y(), 100.0);
  const View above = fitted_view(scene_of(ball(5.0, 8)), cameras::superior(), 200, 200);
  EXPECT_LT(above.project({0, -3, 0}).y(), 100.0);  // front up
  const View left = fitted_view(scene_of(ball(5.0, 8)), cameras::left_lateral(), 200, 200);
  EXPECT_LT(left.project({0, -3, 0}).x(), 100.0);  // front to the left
}

TEST(View, AngiographicAnglesPlaceTheDetector) {
  EXPECT_TRUE(cameras::angiographic(0, 0).direction.isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_LT(cameras::angiographic(45, 0).direction.x(),
            0.0);  // the detector is on the left: it looks to the right
  EXPECT_LT(cameras::angiographic(0, 30).direction.z(), 0.0);  // and above: it looks down
  EXPECT_NEAR(cameras::angiographic(40, 25).direction.norm(), 1.0, 1e-12);
  EXPECT_NO_THROW(fitted_view(scene_of(ball(5.0, 8)), cameras::angiographic(0, 90), 100, 100));
}

TEST(View, BroadsideSeesAFlatShapeFaceOn) {
  std::vector<Vec3> points;
  const Vec3 normal = Vec3(1, 2, 0.5).normalized();
  const Vec3 a = normal.cross(Vec3::UnitZ()).normalized();
  const Vec3 b = normal.cross(a);
  for (int i = 0; i < 50; ++i) points.push_back(20.0 * std::sin(i) * a + 6.0 * std::cos(1.7 * i) * b);
  const Camera camera = cameras::broadside(points);
  EXPECT_NEAR(std::abs(camera.direction.normalized().dot(normal)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(camera.up.normalized().dot(a)), 1.0, 0.02);
  EXPECT_GT(camera.direction.y(), 0.0);
}

TEST(View, ScaleIsExactWhenTheHeightIsGiven) {
  Camera camera;
  camera.focus = Vec3(1, 2, 3);
  camera.height_mm = 50.0;
  const View view = fitted_view(scene_of(ball(5.0, 8)), camera, 200, 100);
  EXPECT_DOUBLE_EQ(view.mm_per_px, 0.5);
  EXPECT_TRUE(view.project({1, 2, 3}).isApprox(Vec2(100, 50), 1e-12));
  EXPECT_TRUE(view.project({11, 2, 3}).isApprox(Vec2(120, 50), 1e-12));
}

TEST(View, RefusesBadCameras) {
  const Scene scene = scene_of(ball(5.0, 8));
  EXPECT_THROW(fitted_view(Scene{}, {}, 100, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {}, 0, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {.direction = Vec3::Zero()}, 100, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {.direction = Vec3::UnitZ()}, 100, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {.field_of_view_deg = 0.0}, 100, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {.margin = 0.5}, 100, 100), InvalidInput);
  EXPECT_THROW(fitted_view(scene, {.height_mm = -1.0}, 100, 100), InvalidInput);
  EXPECT_THROW(cameras::broadside({}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
