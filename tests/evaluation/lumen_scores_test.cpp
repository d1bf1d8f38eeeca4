// Sections of tubes whose scores are known, and the surfaces that contours stand for.

#include "ostia/evaluation/lumen_scores.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::Contour;
using geometry::ContourSection;
using geometry::Vec3;

constexpr double pi = std::numbers::pi;

/// Along +z from z = from, counter-clockwise looking along +z.
ContourSection cylinder(double radius_mm, double from = 5.0, double to = 15.0, int points = 128,
                        double first_angle = 0.0) {
  ContourSection section;
  section.section = "s01";
  section.vessel = "LAD";
  section.observer = "truth";
  const int count = static_cast<int>(std::round((to - from) / 0.5)) + 1;
  for (int k = 0; k < count; ++k) {
    Contour contour{0.5 * k, {}};
    for (int i = 0; i < points; ++i) {
      const double a = first_angle - 2.0 * pi * i / points;
      contour.points.emplace_back(radius_mm * std::cos(a), radius_mm * std::sin(a), from + 0.5 * k);
    }
    section.contours.push_back(contour);
  }
  return section;
}

geometry::TriMesh tube(double radius_mm, const Vec3& shift = Vec3::Zero()) {
  geometry::TriMesh mesh =
      geometry::structured_surface(geometry::straight_tube(20.0, radius_mm).tubes.front(), 256, 0.25);
  for (Vec3& p : mesh.points) p += shift;
  return mesh;
}

TEST(ContourSurface, IsOutwardAndWithoutTwist) {
  const geometry::TriMesh closed = surface_of(cylinder(1.5), {.caps = true});
  EXPECT_EQ(geometry::find_faults(closed, true).self_intersections, 0u);
  EXPECT_EQ(geometry::find_faults(closed, false).open_edges, 0u);
  const double exact = 10.0 * 0.5 * 128 * 1.5 * 1.5 * std::sin(2.0 * pi / 128);
  EXPECT_NEAR(geometry::volume(closed), exact, 1e-9 * exact) << "positive: outward";
  ContourSection turned = cylinder(1.5);
  for (std::size_t k = 0; k < turned.contours.size(); ++k)  // first points anywhere
    std::rotate(turned.contours[k].points.begin(),
                turned.contours[k].points.begin() + static_cast<std::ptrdiff_t>(7 * k % 128),
                turned.contours[k].points.end());
  EXPECT_NEAR(geometry::volume(surface_of(turned, {.caps = true})), exact, 1e-9 * exact);
}

TEST(ContourSurface, FloorFallsWithTheSquareOfTheSpacing) {
  FloorOptions options;
  options.spacings_mm = {0.5, 1.0};
  options.points = {64, 128};
  const std::vector<FloorRow> rows = floor_table(options);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_LE(rows[0].mean_mm, 0.02) << "0.5 mm and 64 points";
  for (const FloorRow& row : rows) {
    EXPECT_GT(row.mean_mm, 0.0);
    EXPECT_GE(row.max_mm, row.mean_mm);
    EXPECT_NEAR(row.estimate_mm, row.mean_mm, 0.6 * row.mean_mm) << row.spacing_mm << " " << row.points;
  }
  EXPECT_LT(rows[1].mean_mm, rows[0].mean_mm);
}

TEST(LumenScores, ConcentricTubes) {
  const LumenResult result(tube(1.65));
  const SectionScore s = result.score(cylinder(1.5));
  ASSERT_TRUE(s.found);
  EXPECT_NEAR(s.msd_mm, 0.15, 0.001);
  EXPECT_NEAR(s.rms_sd_mm, 0.15, 0.001);
  EXPECT_NEAR(s.max_sd_mm, 0.15, 0.002);
  EXPECT_NEAR(s.signed_mean_mm, 0.15, 0.002);
  EXPECT_NEAR(s.dice, 2.0 * 1.5 * 1.5 / (1.5 * 1.5 + 1.65 * 1.65), 0.002);
  EXPECT_NEAR(s.length_mm, 10.0, 1e-12);
}

TEST(LumenScores, AShiftedTube) {
  const double r = 1.5, d = 0.4;
  const SectionScore s = LumenResult(tube(r, Vec3(d, 0.0, 0.0))).score(cylinder(r));
  const double lens = 2.0 * r * r * std::acos(d / (2.0 * r)) - 0.5 * d * std::sqrt(4.0 * r * r - d * d);
  EXPECT_NEAR(s.dice, lens / (pi * r * r), 0.003);
  // Distance from a point of one circle to the other: | |p - c| - r |, averaged over the angle.
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double a = 2.0 * pi * i / 1000;
    mean += std::abs(std::hypot(r * std::cos(a) - d, r * std::sin(a)) - r) / 1000.0;
  }
  EXPECT_NEAR(s.msd_mm, mean, 0.003);
  EXPECT_NEAR(s.max_sd_mm, d, 0.005);
}

TEST(LumenScores, ASectionThatTheResultDoesNotReach) {
  const SectionScore s = LumenResult(tube(1.5)).score(cylinder(1.5, 30.0, 40.0));
  EXPECT_FALSE(s.found);
  EXPECT_EQ(s.dice, 0.0);
  EXPECT_TRUE(std::isnan(s.msd_mm));
  const LumenSummary sum = summarize({s, LumenResult(tube(1.5)).score(cylinder(1.5))});
  EXPECT_EQ(sum.missing, 1u);
  EXPECT_NEAR(sum.dice, 0.5, 0.002) << "counted, not left out";
  EXPECT_LT(sum.msd_mm, 0.002);
}

TEST(LumenScores, StenosesAreGradedAgainstTheirEnds) {
  std::vector<double> s, r;
  for (int i = 0; i <= 100; ++i) {
    const double at = 0.2 * i;
    const double healthy = 2.0 - 0.02 * at;
    const double narrowing = std::abs(at - 10.0) < 3.0 ? 0.3 * (1.0 + std::cos(pi * (at - 10.0) / 3.0)) : 0.0;
    s.push_back(at);
    r.push_back(healthy * (1.0 - narrowing));
  }
  EXPECT_NEAR(diameter_stenosis(s, r), 0.6, 1e-9);
  EXPECT_NEAR(diameter_stenosis(s, std::vector<double>(s.size(), 1.5)), 0.0, 1e-12);
  EXPECT_THROW(diameter_stenosis({0.0, 1.0}, {1.0, 1.0}), InvalidInput);
}

TEST(LumenScores, BadSectionsAreRefused) {
  const LumenResult result(tube(1.5));
  ContourSection crossing = cylinder(1.5);
  std::swap(crossing.contours[3].points[0], crossing.contours[3].points[40]);
  EXPECT_THROW(result.score(crossing), InvalidInput);
  ContourSection single = cylinder(1.5);
  single.contours.resize(1);
  EXPECT_THROW(result.score(single), InvalidInput);
  EXPECT_THROW(LumenResult(geometry::TriMesh{}), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
