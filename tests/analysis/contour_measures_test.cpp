// Closed lines in a plane against exact formulas.

#include "walls/contour_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ostia::analysis {
namespace {

using std::numbers::pi;

std::vector<Vec2> ellipse(double a, double b, int count, const Vec2& centre = Vec2::Zero(),
                          double turn = 0.0) {
  std::vector<Vec2> line;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * pi * i / count, x = a * std::cos(t), y = b * std::sin(t);
    line.push_back(centre +
                   Vec2(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y));
  }
  return line;
}

double ellipse_perimeter(double a, double b) {
  double sum = 0.0;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i)
    sum += std::hypot(a * std::sin(2.0 * pi * i / n), b * std::cos(2.0 * pi * i / n));
  return sum * 2.0 * pi / n;
}

TEST(ContourMeasures, OfACircleAreExactWithFewUnevenPoints) {
  std::vector<Vec2> line;
  for (const double t : {0.0, 0.3, 0.9, 1.2, 1.9, 2.5, 3.0, 3.7, 4.1, 4.9, 5.6}) {
    line.push_back(Vec2(3.0, -1.0) + 1.5 * Vec2(std::cos(t), std::sin(t)));
  }
  const ContourMeasures of = measures_of(line);
  EXPECT_NEAR(of.area_mm2, pi * 2.25, 1e-9);
  EXPECT_NEAR(of.perimeter_mm, 2.0 * pi * 1.5, 1e-9);
  EXPECT_NEAR((of.centroid - Vec2(3.0, -1.0)).norm(), 0.0, 2e-3);
  EXPECT_NEAR(of.least_width_mm, 3.0, 2e-3);
  EXPECT_NEAR(of.largest_width_mm, 3.0, 2e-3);
}

TEST(ContourMeasures, OfAnEllipseConvergeWithTheFourthPower) {
  const double area = pi * 2.0 * 1.2, perimeter = ellipse_perimeter(2.0, 1.2);
  const ContourMeasures coarse = measures_of(ellipse(2.0, 1.2, 16)),
                        fine = measures_of(ellipse(2.0, 1.2, 32));
  EXPECT_NEAR(coarse.area_mm2, area, 5e-3 * area);  // the bare polygon is off by 2.6 %
  EXPECT_NEAR(coarse.perimeter_mm, perimeter, 5e-3 * perimeter);
  EXPECT_GT(std::abs(coarse.area_mm2 - area) / std::abs(fine.area_mm2 - area), 10.0);
  EXPECT_GT(std::abs(coarse.perimeter_mm - perimeter) / std::abs(fine.perimeter_mm - perimeter), 10.0);
}

TEST(ContourMeasures, WidthsOfATurnedEllipseAreItsAxes) {
  for (const double turn : {0.0, 0.4, 1.1, 2.0}) {
    const ContourMeasures of = measures_of(ellipse(2.0, 0.8, 64, Vec2(-5.0, 7.0), turn));
    EXPECT_NEAR(of.largest_width_mm, 4.0, 2e-3) << turn;
    EXPECT_NEAR(of.least_width_mm, 1.6, 2e-3) << turn;
    EXPECT_NEAR((of.centroid - Vec2(-5.0, 7.0)).norm(), 0.0, 1e-9);
  }
}

TEST(ContourMeasures, HollowSidesAreTakenOff) {  // r = 2 + 0.5 cos 3 t: bent inwards between its lobes
  std::vector<Vec2> line;
  for (int i = 0; i < 64; ++i) {
    const double t = 2.0 * pi * i / 64;
    line.push_back((2.0 + 0.5 * std::cos(3.0 * t)) * Vec2(std::cos(t), std::sin(t)));
  }
  EXPECT_NEAR(measures_of(line).area_mm2, pi * (4.0 + 0.125), 2e-3);
}

TEST(ContourMeasures, WidthsEqualTheLargestDistanceAndTheLeastShadow) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec2> line;  // a lumpy star about the origin
    for (int i = 0; i < 300; ++i) {
      const double t = 2.0 * pi * i / 300;
      line.push_back((1.5 + 0.2 * anywhere(random)) * Vec2(std::cos(t), std::sin(t)));
    }
    double largest = 0.0, least = 1e9;
    for (const Vec2& a : line)
      for (const Vec2& b : line) largest = std::max(largest, (a - b).norm());
    for (int k = 0; k < 20000; ++k) {
      const Vec2 along(std::cos(pi * k / 20000), std::sin(pi * k / 20000));
      double low = 1e9, high = -1e9;
      for (const Vec2& p : line) {
        low = std::min(low, p.dot(along));
        high = std::max(high, p.dot(along));
      }
      least = std::min(least, high - low);
    }
    const ContourMeasures of = measures_of(line);
    EXPECT_NEAR(of.largest_width_mm, largest, 1e-9);
    EXPECT_NEAR(of.least_width_mm, least, 1e-3);
    EXPECT_LE(of.least_width_mm, least + 1e-9);
  }
}

TEST(ContourMeasures, FewerThanThreePointsHaveNone) {
  EXPECT_EQ(measures_of({Vec2(0, 0), Vec2(1, 0)}).area_mm2, 0.0);
  EXPECT_EQ(convex_hull({Vec2(1, 1), Vec2(1, 1)}).size(), 1u);
}

TEST(ConvexHull, KeepsCornersAlone) {
  const auto hull = convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}, {2, 2}});
  ASSERT_EQ(hull.size(), 4u);
  EXPECT_EQ(hull[0], Vec2(0, 0));
  EXPECT_EQ(hull[1], Vec2(2, 0));
  EXPECT_EQ(hull[2], Vec2(2, 2));
  EXPECT_EQ(hull[3], Vec2(0, 2));
}

}  // namespace
}  // namespace ostia::analysis
