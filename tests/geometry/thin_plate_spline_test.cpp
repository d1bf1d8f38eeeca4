#include "ostia/geometry/thin_plate_spline.h"

#include "test_meshes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

TEST(ThinPlateSpline, BringsLandmarksToTheirTargets) {
  const auto from = test::random_points(60, 10.0, 1), moves = test::random_points(60, 1.0, 2);
  std::vector<Vec3> to = from;
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += moves[i];
  const ThinPlateSpline spline(from, to);
  for (std::size_t i = 0; i < to.size(); ++i) EXPECT_LT((spline(from[i]) - to[i]).norm(), 1e-8);
}

TEST(ThinPlateSpline, AnAffineMapCostsNoBending) {
  Eigen::Matrix3d a;
  a << 1.2, 0.3, -0.1, 0.0, 0.8, 0.4, 0.2, -0.5, 1.1;
  const Vec3 shift(3.0, -40.0, 7.0);
  const auto from = test::random_points(30, 5.0, 3);
  std::vector<Vec3> to;
  for (const Vec3& p : from) to.push_back(a * p + shift);
  const ThinPlateSpline spline(from, to);
  for (const Vec3& p : test::random_points(50, 20.0, 4))
    EXPECT_LT((spline(p) - (a * p + shift)).norm(), 1e-7);
}

TEST(ThinPlateSpline, TurnsWithItsLandmarks) {
  const auto from = test::random_points(20, 5.0, 5), moves = test::random_points(20, 1.0, 6);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> to, turned_from, turned_to;
  for (std::size_t i = 0; i < from.size(); ++i) {
    to.push_back(from[i] + moves[i]);
    turned_from.push_back(turn * from[i]);
    turned_to.push_back(turn * to.back());
  }
  const ThinPlateSpline spline(from, to), turned(turned_from, turned_to);
  for (const Vec3& p : test::random_points(20, 5.0, 7))
    EXPECT_LT((turn * spline(p) - turned(turn * p)).norm(), 1e-8);
}

TEST(ThinPlateSpline, RefusesWhatHasNoSolution) {
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  EXPECT_THROW(ThinPlateSpline(flat, flat), GeometryError);
  std::vector<Vec3> twice{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}};
  std::vector<Vec3> to = twice;
  to.back().z() = 2.0;
  EXPECT_THROW(ThinPlateSpline(twice, to), GeometryError);
  twice.pop_back();
  EXPECT_THROW(ThinPlateSpline(twice, to), InvalidInput);
  EXPECT_THROW(ThinPlateSpline({twice[0], twice[1]}, {to[0], to[1]}), InvalidInput);
  to.pop_back();
  to[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ThinPlateSpline(twice, to), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
