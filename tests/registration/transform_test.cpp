#include "ostia/registration/transform.h"

#include "spline_levels.h"

#include "ostia/core/error.h"
#include "ostia/registration/transform_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::registration {
namespace {

Mat3 some_linear() {
  return Eigen::AngleAxisd(0.4, Vec3(1, -2, 0.5).normalized()).toRotationMatrix() *
         Vec3(1.1, 0.95, 1.02).asDiagonal();
}

/// Coefficients of a cubic B-spline that sample a linear function give that function back.
SplineGrid linear_shifts(const Mat3& slope) {
  SplineGrid grid = resting_spline({Vec3(-30, -40, -20), Vec3(30, 40, 20)}, 10.0);
  grid.nodes.direction = Mat3::Identity();
  for (std::int64_t k = 0; k < grid.nodes.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.nodes.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.nodes.size[0]; ++i)
        grid.shifts_mm[grid.nodes.offset(i, j, k)] = slope * grid.nodes.world(Vec3(i, j, k));
  return grid;
}

SplineGrid wavy_shifts() {
  SplineGrid grid = linear_shifts(Mat3::Identity());
  for (std::size_t n = 0; n < grid.shifts_mm.size(); ++n) {
    const Vec3 x = grid.shifts_mm[n];
    grid.shifts_mm[n] =
        2.0 * Vec3(std::sin(x.y() / 9.0), std::cos(x.z() / 8.0 + x.x() / 15.0), std::sin(x.x() / 10.0));
  }
  return grid;
}

TEST(Transform, WithoutASplineItIsTheLinearMap) {
  const Transform t(some_linear(), Vec3(3, 4, 5));
  EXPECT_TRUE(t(Vec3(1, 2, 3)).isApprox(some_linear() * Vec3(1, 2, 3) + Vec3(3, 4, 5), 1e-14));
  EXPECT_TRUE(Transform()(Vec3(1, 2, 3)).isApprox(Vec3(1, 2, 3)));
  EXPECT_TRUE(t.inverse(t(Vec3(7, -2, 9))).isApprox(Vec3(7, -2, 9), 1e-12));
}

TEST(Transform, ASplineReproducesLinearShiftsExactly) {
  Mat3 slope;
  slope << 0.02, -0.1, 0.05, 0.07, 0.01, -0.03, -0.04, 0.06, 0.1;
  const Transform t(some_linear(), Vec3(1, 0, -1), linear_shifts(slope));
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(-29, 39, 3), Vec3(11.5, -8.25, 19.9)}) {
    EXPECT_LT((t(p) - (some_linear() * (p + slope * p) + Vec3(1, 0, -1))).norm(), 1e-11);
    EXPECT_LT((t.jacobian(p) - some_linear() * (Mat3::Identity() + slope)).norm(), 1e-11);
  }
}

TEST(Transform, OutsideOfItsGridTheBordersShiftIsKept) {
  const Transform t(Mat3::Identity(), Vec3::Zero(), linear_shifts(0.1 * Mat3::Identity()));
  EXPECT_LT((t(Vec3(100, 0, 0)) - Vec3(103, 0, 0)).norm(), 1e-11);
  EXPECT_LT((t.jacobian(Vec3(100, 0, 0)) - Mat3(Vec3(1, 1.1, 1.1).asDiagonal())).norm(), 1e-11);
}

TEST(Transform, TheJacobianIsTheDifferenceQuotient) {
  const Transform t(some_linear(), Vec3::Zero(), wavy_shifts());
  const Vec3 p(4.3, -11.7, 6.1);
  for (int a = 0; a < 3; ++a) {
    const Vec3 step = 1e-5 * Vec3::Unit(a);
    EXPECT_LT(((t(p + step) - t(p - step)) / 2e-5 - t.jacobian(p).col(a)).norm(), 1e-8);
  }
}

TEST(Transform, TheInverseBringsEveryPointBack) {
  const Transform t(some_linear(), Vec3(5, 6, 7), wavy_shifts());
  for (double x = -40; x <= 40; x += 13)
    for (double y = -50; y <= 50; y += 17)
      for (double z = -30; z <= 30; z += 11)
        EXPECT_LT((t.inverse(t(Vec3(x, y, z))) - Vec3(x, y, z)).norm(), 1e-4);
}

TEST(Transform, BadPartsAreRefused) {
  EXPECT_THROW(Transform(Mat3::Zero(), Vec3::Zero()), InvalidInput);
  EXPECT_THROW(Transform(Mat3::Identity(), Vec3(NAN, 0, 0)), InvalidInput);
  SplineGrid grid = wavy_shifts();
  grid.shifts_mm.pop_back();
  EXPECT_THROW(Transform(Mat3::Identity(), Vec3::Zero(), grid), InvalidInput);
  grid = wavy_shifts();
  grid.nodes.direction.col(0) *= -1.0;
  EXPECT_THROW(Transform(Mat3::Identity(), Vec3::Zero(), grid), InvalidInput);
}

TEST(SplineLevels, TheRefinedSplineIsTheSame) {
  const SplineGrid coarse = wavy_shifts(), fine = refined(coarse);
  EXPECT_DOUBLE_EQ(fine.nodes.spacing[0], 0.5 * coarse.nodes.spacing[0]);
  const Transform a(Mat3::Identity(), Vec3::Zero(), coarse), b(Mat3::Identity(), Vec3::Zero(), fine);
  for (double x = -30; x <= 30; x += 7.5)
    for (double y = -40; y <= 40; y += 9.1)
      for (double z = -20; z <= 20; z += 6.3) EXPECT_LT((a(Vec3(x, y, z)) - b(Vec3(x, y, z))).norm(), 1e-12);
}

TEST(TransformJson, ComesBackToTheLastBit) {
  const Transform t(some_linear(), Vec3(1.0 / 3.0, 1e-17, 2e5), wavy_shifts());
  const Transform read = transform_of_json(to_json(t));
  EXPECT_EQ(to_json(read), to_json(t));
  EXPECT_EQ(read(Vec3(3, 4, 5)), t(Vec3(3, 4, 5)));
  const Transform plain = transform_of_json(to_json(Transform()));
  EXPECT_FALSE(plain.spline());
}

TEST(TransformJson, BadTextIsNamed) {
  const auto message = [](const std::string& text) {
    try {
      transform_of_json(text);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("nonsense"), testing::HasSubstr("not a JSON object"));
  EXPECT_THAT(message(R"({"offset_mm":[0,0,0]})"), testing::HasSubstr("linear"));
  EXPECT_THAT(message(R"({"linear":[[1,0,0],[0,1,0],[0,0,"a"]],"offset_mm":[0,0,0]})"),
              testing::HasSubstr("linear"));
  std::string text = to_json(Transform(Mat3::Identity(), Vec3::Zero(), wavy_shifts()));
  text.replace(text.find("\"shifts_mm\":["), 13, "\"shifts_mm\":[0,");
  EXPECT_THAT(message(text), testing::HasSubstr("shifts_mm"));
  EXPECT_THAT(
      message(R"({"linear":[[1,0,0],[0,1,0],[0,0,1]],"offset_mm":[0,0,0],"spline":{"size":[1e9,4,4]}})"),
      testing::HasSubstr("size"));
}

}  // namespace
}  // namespace ostia::registration
