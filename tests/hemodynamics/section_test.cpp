// What a section's form does to the flow: against closed solutions.

#include "ostia/hemodynamics/section.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::hemodynamics {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Vec2> ellipse(double a, double b, int points, const Vec2& at = {0.0, 0.0}) {
  std::vector<Vec2> contour;
  for (int i = 0; i < points; ++i) {
    const double t = 2.0 * pi * i / points;
    contour.emplace_back(at.x() + a * std::cos(t), at.y() + b * std::sin(t));
  }
  return contour;
}

TEST(SectionShape, OfAnEllipseIsExact) {
  EXPECT_DOUBLE_EQ(shape_of_ellipse(1.5, 1.5).viscous, 1.0);
  EXPECT_NEAR(shape_of_ellipse(1.5, 1.5).perimeter, 1.0, 1e-12);
  EXPECT_NEAR(shape_of_ellipse(2.0, 1.0).viscous, 1.25, 1e-15);
  // Perimeter of the ellipse 2 : 1 by its elliptic integral: 9.688448220547675.
  EXPECT_NEAR(shape_of_ellipse(2.0, 1.0).perimeter, 9.688448220547675 / (2.0 * pi * std::sqrt(2.0)), 1e-6);
  EXPECT_THROW(shape_of_ellipse(0.0, 1.0), InvalidInput);
}

TEST(SectionShape, OfContoursOfCirclesAndEllipses) {
  EXPECT_NEAR(shape_of_contour(ellipse(1.3, 1.3, 64, {5.0, -3.0})).viscous, 1.0, 1e-6);
  EXPECT_NEAR(shape_of_contour(ellipse(1.5, 1.2, 128)).viscous, shape_of_ellipse(1.5, 1.2).viscous, 1e-6);
  EXPECT_NEAR(shape_of_contour(ellipse(2.0, 1.0, 256)).viscous, 1.25, 1e-5);
}

TEST(SectionShape, OfATriangleWithEqualSides) {
  // Mean velocity a^2 / 80 (White, Viscous Fluid Flow): area / (8 pi G) = sqrt(3) 20 / (8 pi).
  std::vector<Vec2> contour;
  const std::vector<Vec2> corners = {{1.0, 0.0}, {-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};
  for (std::size_t c = 0; c < 3; ++c)
    for (int i = 0; i < 60; ++i)
      contour.push_back(corners[c] + (corners[(c + 1) % 3] - corners[c]) * (i / 60.0));
  EXPECT_NEAR(shape_of_contour(contour).viscous, std::sqrt(3.0) * 20.0 / (8.0 * pi), 0.003);
}

TEST(SectionShape, OfWhatIsNotSeenFromItsMiddle) {
  // A thin horseshoe: by the moment of inertia, far above a circle.
  std::vector<Vec2> contour;
  for (int i = 0; i <= 40; ++i)
    contour.push_back(2.0 * Vec2(std::cos(1.5 * pi * i / 40), std::sin(1.5 * pi * i / 40)));
  for (int i = 40; i >= 0; --i)
    contour.push_back(1.5 * Vec2(std::cos(1.5 * pi * i / 40), std::sin(1.5 * pi * i / 40)));
  EXPECT_GT(shape_of_contour(contour).viscous, 4.0);
}

TEST(SectionShape, OfAreaAndPerimeterIsTheEllipse) {
  const SectionShape shape = shape_of_ellipse(1.8, 1.0);
  const double area = pi * 1.8, perimeter = shape.perimeter * 2.0 * std::sqrt(pi * area);
  EXPECT_NEAR(shape_of_measures(area, perimeter).viscous, shape.viscous, 1e-6);
  EXPECT_EQ(shape_of_measures(area, 0.5 * perimeter).viscous, 1.0);
  EXPECT_THROW(shape_of_measures(0.0, 1.0), InvalidInput);
}

TEST(SectionShape, RefusesWhatIsNoContour) {
  EXPECT_THROW(shape_of_contour(ellipse(1.0, 1.0, 7)), InvalidInput);
  auto clockwise = ellipse(1.0, 1.0, 32);
  std::reverse(clockwise.begin(), clockwise.end());
  EXPECT_THROW(shape_of_contour(clockwise), InvalidInput);
}

}  // namespace
}  // namespace ostia::hemodynamics
