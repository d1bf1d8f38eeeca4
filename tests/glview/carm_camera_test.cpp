#include "ostia/glview/carm_camera.h"

#include "ostia/core/error.h"
#include "ostia/figure/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::glview {
namespace {

double apart(const Vec3& a, const Vec3& b) {
  return (a - b).norm();
}

Camera at(double lao, double cranial) {
  Camera camera;
  camera.angles = {lao, cranial};
  return camera;
}

TEST(CarmCamera, KnownDirections) {
  const double half = std::sqrt(0.5);
  EXPECT_LT(apart(at(0, 0).towards(), Vec3(0, -1, 0)), 1e-12) << "AP: the receptor is in front";
  EXPECT_LT(apart(at(90, 0).towards(), Vec3(1, 0, 0)), 1e-12) << "LAO 90: at the patient's left";
  EXPECT_LT(apart(at(-90, 0).towards(), Vec3(-1, 0, 0)), 1e-12) << "RAO 90: at the patient's right";
  EXPECT_LT(apart(at(45, 0).towards(), Vec3(half, -half, 0)), 1e-12);
  EXPECT_LT(apart(at(0, 45).towards(), Vec3(0, -half, half)), 1e-12) << "cranial: towards the head";
  EXPECT_LT(apart(at(0, -45).towards(), Vec3(0, -half, -half)), 1e-12);
  EXPECT_LT(apart(at(30, 20).towards(), Vec3(0.469846, -0.813798, 0.342020)), 1e-6);
}

TEST(CarmCamera, DirectionsAreThoseOfFigures) {
  for (const double lao : {-120.0, -30.0, 0.0, 45.0, 90.0})
    for (const double cranial : {-40.0, 0.0, 25.0})
      EXPECT_LT(apart(at(lao, cranial).towards(),
                      -figure::cameras::angiographic(lao, cranial).direction.normalized()),
                1e-12);
}

TEST(CarmCamera, AxesAreOrthonormalAndThePatientsLeftIsOnTheRightFromTheFront) {
  EXPECT_LT(apart(at(0, 0).right(), Vec3(1, 0, 0)), 1e-12);
  EXPECT_LT(apart(at(0, 0).up(), Vec3(0, 0, 1)), 1e-12);
  EXPECT_LT(apart(at(90, 0).right(), Vec3(0, 1, 0)), 1e-12) << "from the left the back is on the right";
  for (const double lao : {-170.0, -30.0, 60.0})
    for (const double cranial : {-90.0, -20.0, 0.0, 50.0, 90.0}) {
      const Camera camera = at(lao, cranial);
      EXPECT_NEAR(camera.up().dot(camera.towards()), 0.0, 1e-12);
      EXPECT_NEAR(camera.right().norm(), 1.0, 1e-12);
      EXPECT_GE(camera.up().z(), -1e-12);
    }
}

TEST(CarmCamera, AnglesAsTheyAreWritten) {
  const auto expect = [](const char* text, double lao, double cranial) {
    const CarmAngles angles = carm_angles(text);
    EXPECT_DOUBLE_EQ(angles.lao_deg, lao) << text;
    EXPECT_DOUBLE_EQ(angles.cranial_deg, cranial) << text;
  };
  expect("AP", 0, 0);
  expect("ap", 0, 0);
  expect("LAT", 90, 0);
  expect("LAO30CRA20", 30, 20);
  expect("rao 30 cau 25", -30, -25);
  expect("LAO 50, CRA 30", 50, 30);
  expect("RAO7.5", -7.5, 0);
  expect("CAU25", 0, -25);
  for (const char* wrong :
       {"", "LAO", "30", "LAO30CRA", "LAO200", "CRA91", "LAO30RAO20", "LAO-30", "LAOnan", "AP3"})
    EXPECT_THROW(carm_angles(wrong), UsageError) << wrong;
  EXPECT_EQ(text_of({30, 20}), "LAO 30 CRA 20");
  EXPECT_EQ(text_of({-30, -25}), "RAO 30 CAU 25");
  EXPECT_EQ(text_of({0.2, -0.3}), "AP");
  EXPECT_EQ(text_of({0, 40}), "CRA 40");
}

TEST(CarmCamera, TheMatrixProjectsAsTheFormulaDoes) {
  for (const Projection projection : {Projection::lit, Projection::x_ray}) {
    Camera camera = at(37, -21);
    camera.isocentre = Vec3(5, -80, 1200);
    camera.half_height_mm = 42;
    camera.projection = projection;
    for (const Vec3& off : {Vec3(0, 0, 0), Vec3(20, 3, -15), Vec3(-11, 30, 8)}) {
      const Vec3 point = camera.isocentre + off;
      const Eigen::Vector4f clip = camera.clip_of_world(1024.0 / 768.0) * point.cast<float>().homogeneous();
      EXPECT_GT(clip.w(), 0.0F);
      EXPECT_LT(std::abs(clip.z()), clip.w());
      const Vec2 px = camera.project(point, 1024, 768);
      EXPECT_NEAR(static_cast<double>((clip.x() / clip.w() + 1.0F) / 2.0F * 1024.0F), px.x(), 0.02);
      EXPECT_NEAR(static_cast<double>((1.0F - clip.y() / clip.w()) / 2.0F * 768.0F), px.y(), 0.02);
    }
  }
}

TEST(CarmCamera, WhatIsNearerToTheSourceIsLargerOnTheMonitor) {
  Camera camera = at(0, 0);
  camera.half_height_mm = 60.0;
  camera.projection = Projection::x_ray;
  const auto right_of_middle = [&](const Vec3& p) { return camera.project(p, 800, 600).x() - 400.0; };
  // 5 px a mm at the isocentre, 750 mm from the source, which is behind the patient (+y).
  EXPECT_NEAR(right_of_middle(Vec3(10, 0, 0)), 50.0, 1e-9);
  EXPECT_NEAR(right_of_middle(Vec3(10, 50, 0)), 50.0 * 750.0 / 700.0, 1e-9);
  EXPECT_NEAR(right_of_middle(Vec3(10, -50, 0)), 50.0 * 750.0 / 800.0, 1e-9);
  camera.projection = Projection::lit;  // the eye is in front
  EXPECT_GT(right_of_middle(Vec3(10, -50, 0)), right_of_middle(Vec3(10, 50, 0)));
  EXPECT_NEAR(right_of_middle(Vec3(10, 0, 0)), 50.0, 1e-9) << "both have one scale at the isocentre";
}

TEST(CarmCamera, AllPointsAreInThePictureFromEverywhere) {
  const std::vector<Vec3> points{Vec3(-30, -20, -45), Vec3(40, 25, 50), Vec3(40, -20, -45), Vec3(0, 5, 50)};
  for (const double lao : {-60.0, 0.0, 33.0, 90.0})
    for (const double aspect : {0.5, 1.0, 2.0})
      for (const Projection projection : {Projection::lit, Projection::x_ray}) {
        Camera camera = camera_on(points, {lao, 20.0}, aspect);
        camera.projection = projection;
        double nearest = 1e9;
        for (const Vec3& p : points) {
          const Vec2 px = camera.project(p, 600.0 * aspect, 600.0);
          nearest = std::min({nearest, px.x(), px.y(), 600.0 * aspect - px.x(), 600.0 - px.y()});
        }
        EXPECT_GT(nearest, 0.0) << lao << " " << aspect;
        EXPECT_LT(nearest, 150.0) << "not lost in it either";
      }
}

TEST(CarmCamera, TheHandTurnsShiftsAndEnlarges) {
  const Camera front = at(0, 0);
  // A point on the near side follows the hand.
  const Vec3 near(0, -30, 0);
  const Vec2 before = front.project(near, 800, 600);
  EXPECT_GT(turned(front, 60, 0, 600).project(near, 800, 600).x(), before.x());
  EXPECT_LT(turned(front, 0, 60, 600).project(near, 800, 600).y(), before.y()) << "up";
  EXPECT_DOUBLE_EQ(turned(front, 0, -900, 600).angles.cranial_deg, 90.0);
  EXPECT_NEAR(turned(at(170, 0), -100, 0, 600).angles.lao_deg, -160.0, 1e-9);
  const Camera moved = shifted(front, 25, -10, 600);
  EXPECT_NEAR(moved.project(Vec3::Zero(), 800, 600).x(), 425.0, 1e-9);
  EXPECT_NEAR(moved.project(Vec3::Zero(), 800, 600).y(), 310.0, 1e-9);
  EXPECT_NEAR(enlarged(front, 2.0).half_height_mm, front.half_height_mm / 2.0, 1e-12);
  EXPECT_GE(enlarged(front, 1e9).half_height_mm, 1.0);
}

}  // namespace
}  // namespace ostia::glview
