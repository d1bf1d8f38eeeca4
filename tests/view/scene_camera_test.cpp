#include "ostia/view/scene_camera.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace ostia::view {
namespace {

const Vec3 no_place = Vec3::Zero();

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-9) {
  EXPECT_LT((a - b).norm(), tolerance) << a.transpose() << " is not " << b.transpose();
}

TEST(SceneCamera, SidesLookAsRadiologistsExpect) {
  const CameraPose front = pose_from(ViewFrom::anterior, {1, 2, 3}, 40.0);
  expect_near(front.towards, {0, -1, 0});
  expect_near(front.right(), {1, 0, 0});  // the patient's left on the picture's right
  expect_near(front.up, {0, 0, 1});
  expect_near(pose_from(ViewFrom::left, no_place, 1.0).right(), {0, 1, 0});  // posterior
  expect_near(pose_from(ViewFrom::right, no_place, 1.0).right(), {0, -1, 0});
  expect_near(pose_from(ViewFrom::cranial, no_place, 1.0).right(), {-1, 0, 0});
  expect_near(pose_from(ViewFrom::cranial, no_place, 1.0).up, {0, -1, 0});
  for (const ViewFrom side : {ViewFrom::anterior, ViewFrom::posterior, ViewFrom::left, ViewFrom::right,
                              ViewFrom::cranial, ViewFrom::caudal})
    EXPECT_NO_THROW(validate(pose_from(side, no_place, 10.0)));
}

TEST(SceneCamera, CarmAnglesAreTheReceptorsPlace) {
  expect_near(pose_of_carm({0.0, 0.0}, no_place, 1.0).towards, {0, -1, 0});
  expect_near(pose_of_carm({90.0, 0.0}, no_place, 1.0).towards, {1, 0, 0});  // the patient's left
  expect_near(pose_of_carm({-90.0, 0.0}, no_place, 1.0).towards, {-1, 0, 0});
  const double s = std::sin(25.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(pose_of_carm({40.0, 25.0}, no_place, 1.0).towards.z(), s, 1e-12);  // towards the head
  for (const CarmAngles angles : {CarmAngles{40.0, 25.0}, {-30.0, -20.0}, {120.0, 5.0}}) {
    const CarmAngles back = carm_angles(pose_of_carm(angles, {5, 6, 7}, 20.0));
    EXPECT_NEAR(back.lao_deg, angles.lao_deg, 1e-9);
    EXPECT_NEAR(back.cranial_deg, angles.cranial_deg, 1e-9);
  }
}

TEST(SceneCamera, BroadsideShowsTheWholeCourse) {
  std::vector<Vec3> arc;  // half a circle in an oblique plane
  const Vec3 u = Vec3(1, 0, 1).normalized(), v = Vec3(0, 1, 0), normal = u.cross(v);
  for (int i = 0; i <= 50; ++i)
    arc.push_back(40.0 * (std::cos(i * 0.0628) * u + std::sin(i * 0.0628) * v) + Vec3(5, 5, 5));
  const CameraPose pose = pose_broadside(arc, 1.5);
  EXPECT_NEAR(std::abs(pose.towards.dot(normal)), 1.0, 1e-6);
  for (const Vec3& point : arc) {
    EXPECT_LE(std::abs((point - pose.target).dot(pose.up)), pose.half_height_mm);
    EXPECT_LE(std::abs((point - pose.target).dot(pose.right())), 1.5 * pose.half_height_mm);
  }
  const std::vector<Vec3> line{{0, 0, 0}, {0, 0, 10}, {0, 0, 30}};
  const CameraPose straight = pose_broadside(line, 1.0);
  expect_near(straight.towards, {0, -1, 0}, 1e-6);  // from the front, since every side shows the same
  expect_near(straight.up, {0, 0, 1}, 1e-6);
  EXPECT_THROW(pose_broadside(std::vector<Vec3>{{0, 0, 0}}, 1.0), InvalidInput);
  EXPECT_THROW(pose_broadside(std::vector<Vec3>{{0, 0, 0}, {std::nan(""), 0, 0}}, 1.0), InvalidInput);
}

TEST(SceneCamera, DragsMoveWhatIsUnderThePointer) {
  const CameraPose pose = pose_from(ViewFrom::anterior, {0, 0, 0}, 50.0);  // 200 pixels: 0.5 mm each
  const CameraPose panned_by = panned(pose, 10.0, -4.0, 200);
  expect_near(panned_by.target, {-5.0, 0.0, 2.0});
  // What is nearest to the viewer follows the pointer: to the right.
  const CameraPose turned = rotated(pose, 20.0, 0.0, 200);
  EXPECT_GT(Vec3(0, -10, 0).dot(turned.right()), 1.0);
  EXPECT_NEAR(Vec3(0, -10, 0).dot(turned.up), 0.0, 1e-9);
  const CameraPose lifted = rotated(pose, 0.0, 20.0, 200);
  EXPECT_GT(Vec3(0, -10, 0).dot(lifted.up), 1.0);
  expect_near(rotated(pose, 200.0, 0.0, 200).towards, -pose.towards);  // over the height: 180 degrees
  CameraPose often = pose;
  for (int i = 0; i < 5000; ++i) often = rotated(often, 3.0, 1.7, 200);
  EXPECT_NO_THROW(validate(often));
  EXPECT_THROW(rotated(pose, 1.0, 1.0, 0), InvalidInput);
}

TEST(SceneCamera, ZoomKeepsThePlaceUnderThePointer) {
  const CameraPose pose = pose_of_carm({30.0, 20.0}, {1, 2, 3}, 50.0);
  const Vec3 fixed = pose.target + 12.0 * pose.right() - 7.0 * pose.up + 30.0 * pose.towards;
  const CameraPose nearer = zoomed(pose, 2.0, fixed);
  EXPECT_DOUBLE_EQ(nearer.half_height_mm, 25.0);
  EXPECT_NEAR((fixed - nearer.target).dot(nearer.right()) / nearer.half_height_mm, 12.0 / 50.0, 1e-12);
  EXPECT_NEAR((fixed - nearer.target).dot(nearer.up) / nearer.half_height_mm, -7.0 / 50.0, 1e-12);
  EXPECT_THROW(zoomed(pose, 0.0, fixed), InvalidInput);
  EXPECT_GE(zoomed(pose, 1e300, fixed).half_height_mm, 1e-3);
}

TEST(SceneCamera, BlendsAlongTheShortestTurn) {
  const CameraPose from = pose_from(ViewFrom::anterior, {0, 0, 0}, 10.0),
                   to = pose_from(ViewFrom::left, {4, 0, 0}, 40.0);
  const CameraPose middle = blended(from, to, 0.5);
  expect_near(middle.towards, Vec3(1, -1, 0).normalized());
  expect_near(middle.target, {2, 0, 0});
  EXPECT_NEAR(middle.half_height_mm, 20.0, 1e-9);
  expect_near(blended(from, to, -1.0).towards, from.towards);
  expect_near(blended(from, to, 1.0).towards, to.towards);
  EXPECT_NO_THROW(validate(blended(from, pose_from(ViewFrom::posterior, no_place, 1.0), 0.3)));
}

TEST(SceneCamera, FitHoldsAllPointsAndRefusesNone) {
  const std::vector<Vec3> points{{-10, 0, 0}, {30, 4, 2}, {5, -3, 20}};
  const CameraPose pose = fitted(pose_from(ViewFrom::anterior, no_place, 1.0), points, 2.0);
  EXPECT_NEAR(pose.target.x(), 10.0, 1e-9);
  EXPECT_NEAR(pose.half_height_mm, 1.08 * std::max(20.0 / 2.0, 10.0), 1e-9);
  EXPECT_THROW(fitted(pose, std::vector<Vec3>{}, 1.0), InvalidInput);
  EXPECT_THROW(fitted(pose, std::vector<Vec3>{{0, 0, std::numeric_limits<double>::infinity()}}, 1.0),
               InvalidInput);
}

TEST(SceneCamera, RollTurnsThePictureCounterClockwise) {
  const CameraPose pose = pose_from(ViewFrom::anterior, no_place, 10.0);
  const CameraPose turned = rolled(pose, 90.0);
  EXPECT_NEAR(Vec3(0, 0, 1).dot(turned.right()), -1.0, 1e-9);  // what was up is now to the left
}

}  // namespace
}  // namespace ostia::view
