#include "ostia/glview/tree_camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::glview {
namespace {

using geometry::Vec2;
using geometry::Vec3;

TreeCamera some_eye() {
  TreeCamera eye;
  eye.target = Vec3(3.0, -2.0, 5.0);
  eye.distance_mm = 40.0;
  eye.width_px = 800;
  eye.height_px = 600;
  return turned(eye, {130.0, -70.0});
}

TEST(TreeCamera, RaysMeetWhatIsAtTheirPlace) {
  const TreeCamera eye = some_eye();
  for (const Vec3& point : {Vec3(3.0, -2.0, 5.0), Vec3(5.0, 1.0, 3.0), Vec3(-4.0, 2.0, 9.0)}) {
    const auto place = eye.place_of(point);
    ASSERT_TRUE(place);
    const CameraRay ray = eye.ray(*place);
    const Vec3 way = (point - ray.origin).normalized();
    EXPECT_LT((way - ray.direction.normalized()).norm(), 1e-12);
  }
  EXPECT_FALSE(eye.place_of(eye.eye() + eye.back));
  EXPECT_NEAR((*eye.place_of(eye.target) - Vec2(400.0, 300.0)).norm(), 0.0, 1e-9);
  // A pixel further is a pixel's height further.
  EXPECT_NEAR((eye.place_of(eye.target + eye.pixel_mm() * eye.up)->y()), 299.0, 1e-9);
}

TEST(TreeCamera, TurnsMovesAndComesNearer) {
  const TreeCamera eye = some_eye();
  const TreeCamera about = turned(eye, {whole_turn_px, 0.0});
  EXPECT_LT((about.back - eye.back).norm(), 1e-9);
  EXPECT_NEAR((eye.eye() - eye.target).norm(), 40.0, 1e-12);
  EXPECT_NEAR(about.right.dot(about.up), 0.0, 1e-12);
  const TreeCamera aside = moved(eye, {10.0, 20.0});
  EXPECT_LT((*aside.place_of(eye.target) - Vec2(410.0, 320.0)).norm(), 1e-9);
  const Vec2 at(650.0, 120.0);
  const Vec3 point = eye.ray(at).origin + 40.0 * eye.ray(at).direction;  // as deep as the target
  const TreeCamera close = nearer(eye, 0.25, at);
  EXPECT_NEAR(close.distance_mm, 10.0, 1e-12);
  EXPECT_LT((*close.place_of(point) - at).norm(), 1e-9);
}

TEST(TreeCamera, FitsABoxOfAnySize) {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const int width : {200, 800}) {
      TreeCamera eye = some_eye();
      eye.width_px = width;
      const TreeCamera all = fitted(eye, Vec3::Constant(-size), Vec3(size, 2.0 * size, 0.5 * size));
      for (int c = 0; c < 8; ++c) {
        const auto place =
            all.place_of(Vec3(c & 1 ? size : -size, c & 2 ? 2.0 * size : -size, c & 4 ? 0.5 * size : -size));
        ASSERT_TRUE(place);
        EXPECT_TRUE(place->x() > 0.0 && place->x() < width && place->y() > 0.0 && place->y() < 600.0);
      }
    }
}

}  // namespace
}  // namespace ostia::glview
