#include "ostia/geometry/polyline.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

const std::vector<Vec3> corner{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 4, 0)};

TEST(Polyline, LengthAndAbscissasAreSumsOfPieces) {
  EXPECT_DOUBLE_EQ(length(corner), 7.0);
  EXPECT_EQ(abscissas(corner), (std::vector<double>{0.0, 3.0, 7.0}));
  EXPECT_TRUE(abscissas({}).empty());
  EXPECT_EQ(length({}), 0.0);
}

TEST(Polyline, PointAtAbscissaIsOnTheRightPiece) {
  const PolylineLocation place = at_abscissa(corner, 5.0);
  EXPECT_EQ(place.segment, 1u);
  EXPECT_DOUBLE_EQ(place.t, 0.5);
  EXPECT_DOUBLE_EQ(place.abscissa, 5.0);
  EXPECT_TRUE(place.point.isApprox(Vec3(3, 2, 0)));
}

TEST(Polyline, AbscissaIsClampedToTheEnds) {
  EXPECT_EQ(at_abscissa(corner, -1.0).point, corner.front());
  EXPECT_EQ(at_abscissa(corner, 99.0).point, corner.back());
  EXPECT_EQ(at_abscissa(corner, 99.0).segment, 1u);
  EXPECT_DOUBLE_EQ(at_abscissa(corner, 99.0).t, 1.0);
}

TEST(Polyline, ClosestFindsFootOnPieceAndCorner) {
  const PolylineLocation foot = closest(corner, Vec3(1, -2, 0));
  EXPECT_EQ(foot.segment, 0u);
  EXPECT_TRUE(foot.point.isApprox(Vec3(1, 0, 0)));
  EXPECT_DOUBLE_EQ(foot.abscissa, 1.0);
  EXPECT_TRUE(closest(corner, Vec3(5, -1, 0)).point.isApprox(Vec3(3, 0, 0)));
  EXPECT_TRUE(closest(corner, Vec3(3, 9, 0)).point.isApprox(Vec3(3, 4, 0)));
}

TEST(Polyline, ClosestTakesTheFirstOfEquals) {
  const std::vector<Vec3> v{Vec3(-1, 1, 0), Vec3(0, 0, 0), Vec3(1, 1, 0)};
  EXPECT_EQ(closest(v, Vec3(0, 1, 0)).segment, 0u);
}

TEST(Polyline, ResampleKeepsEndsAndEqualSteps) {
  std::vector<Vec3> circle;
  for (int i = 0; i <= 1000; ++i) {
    const double angle = std::numbers::pi * i / 1000.0;
    circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const std::vector<Vec3> steps = resample(circle, 0.1);
  ASSERT_EQ(steps.size(), 33u);  // pi / 0.1 = 31.4: 32 steps
  EXPECT_EQ(steps.front(), circle.front());
  EXPECT_EQ(steps.back(), circle.back());
  const double chord = 2.0 * std::sin(std::numbers::pi / 64.0);
  for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_NEAR((steps[i] - steps[i - 1]).norm(), chord, 1e-5);
}

TEST(Polyline, ResampleOfAWholeNumberOfStepsAddsNone) {
  EXPECT_EQ(resample({Vec3(0, 0, 0), Vec3(0.3, 0, 0)}, 0.1).size(), 4u);
}

TEST(Polyline, RefusesBadInput) {
  EXPECT_THROW(at_abscissa({Vec3::Zero()}, 0.0), InvalidInput);
  EXPECT_THROW(at_abscissa(corner, std::nan("")), InvalidInput);
  EXPECT_THROW(closest({}, Vec3::Zero()), InvalidInput);
  EXPECT_THROW(resample(corner, 0.0), InvalidInput);
  EXPECT_THROW(resample(corner, std::nan("")), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
