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

using std::numbers::pi;

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

geometry::TriMesh tube(double radius_mm, const Vec3& shift = Vec3::Zero(), int around = 256) {
  geometry::TriMesh mesh =
      geometry::structured_surface(geometry::straight_tube(20.0, radius_mm).tubes.front(), around, 0.25);
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

/// [Wels]'s tool had 0.06 and 0.08 mm.
TEST(ContourSurface, FloorOnABentTaperedStenosedTube) {
  FloorOptions options;
  options.spacings_mm = {0.5, 1.0};
  options.points = {32, 64};
  const std::vector<FloorRow> rows = floor_table(options);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_LE(rows[1].mean_mm, 0.02) << "0.5 mm and 64 points";
  for (const FloorRow& row : rows) {
    EXPECT_GT(row.mean_mm, 0.0);
    EXPECT_GE(row.max_mm, row.mean_mm);
    EXPECT_NEAR(row.estimate_mm, row.mean_mm, 0.6 * row.mean_mm) << row.spacing_mm << " " << row.points;
  }
  EXPECT_GT(rows[0].mean_mm, 2.5 * rows[1].mean_mm)
      << "with the square of the points, as long as they decide";
  EXPECT_GT(rows[3].mean_mm, rows[1].mean_mm);
}

/// A round straight tube's floor has a closed form: the chord's mean distance from the arc.
TEST(ContourSurface, FloorOfARoundStraightTube) {
  FloorOptions options;
  options.spacings_mm = {0.5};
  options.points = {32};
  options.ring_radius_mm = 1e5;  // bends by 5e-4 mm over its length
  options.radius_mm = options.radius_end_mm = 1.5;
  options.severity = options.oval = options.triangular = 0.0;
  const FloorRow row = floor_table(options).front();
  const double r = 1.5, half = r * std::sin(pi / 32), apothem = r * std::cos(pi / 32);
  double mean = 0.0;
  for (int i = 0; i < 1000; ++i) mean += (r - std::hypot(apothem, half * (i + 0.5) / 1000)) / 1000.0;
  EXPECT_NEAR(row.mean_mm, mean, 0.03 * mean) << "by 16 samples a triangle";
}

TEST(LumenScores, ConcentricTubes) {
  const LumenResult result(tube(1.65, Vec3::Zero(), 512));
  const SectionScore s = result.score(cylinder(1.5, 5.0, 15.0, 512), {.line_mm = 0.01});
  ASSERT_TRUE(s.found);
  EXPECT_NEAR(s.msd_mm, 0.15, 1.5e-4);
  EXPECT_NEAR(s.rms_sd_mm, 0.15, 1.5e-4);
  EXPECT_NEAR(s.max_sd_mm, 0.15, 1.5e-4);
  EXPECT_NEAR(s.signed_mean_mm, 0.15, 3e-4) << "two areas by lines";
  EXPECT_NEAR(s.dice, 2.0 * 1.5 * 1.5 / (1.5 * 1.5 + 1.65 * 1.65), 1e-3);
  EXPECT_NEAR(s.length_mm, 10.0, 1e-12);
}

TEST(LumenScores, AShiftedTube) {
  const double r = 1.5, d = 0.4;
  const SectionScore s = LumenResult(tube(r, Vec3(d, 0.0, 0.0), 512))
                             .score(cylinder(r, 5.0, 15.0, 512), {.sample_mm = 0.1, .line_mm = 0.01});
  const double lens = 2.0 * r * r * std::acos(d / (2.0 * r)) - 0.5 * d * std::sqrt(4.0 * r * r - d * d);
  EXPECT_NEAR(s.dice, lens / (pi * r * r), 1e-3);
  // Distance from a point of one circle to the other: | |p - c| - r |, averaged over the angle.
  double mean = 0.0, squares = 0.0;
  for (int i = 0; i < 10000; ++i) {
    const double a = 2.0 * pi * i / 10000;
    const double one = std::abs(std::hypot(r * std::cos(a) - d, r * std::sin(a)) - r);
    mean += one / 10000.0;
    squares += one * one / 10000.0;
  }
  EXPECT_NEAR(s.msd_mm, mean, 1e-3 * mean);
  EXPECT_NEAR(s.rms_sd_mm, std::sqrt(squares), 1e-3 * std::sqrt(squares));
  EXPECT_NEAR(s.max_sd_mm, d, 1e-3 * d);
  EXPECT_NEAR(s.signed_mean_mm, 0.0, 5e-4) << "both are as wide";
}

/// The result ends in the middle of the section: half the reference is up to 5 mm away from it.
TEST(LumenScores, AResultThatEndsWithinTheSection) {
  const SectionScore s =
      LumenResult(tube(1.5, Vec3::Zero(), 512)).score(cylinder(1.5, 14.75, 25.25, 512), {.line_mm = 0.01});
  ASSERT_TRUE(s.found);
  const double covered = 5.25, bare = 5.25;  // mm
  EXPECT_NEAR(s.dice, 2.0 * covered / (covered + covered + bare), 1e-3);
  const double area = covered + bare + covered;
  EXPECT_NEAR(s.msd_mm, 0.5 * bare * bare / area, 1e-3 * 0.5 * bare * bare / area);
  EXPECT_NEAR(s.rms_sd_mm, std::sqrt(bare * bare * bare / 3.0 / area), 2e-3);
  EXPECT_NEAR(s.max_sd_mm, bare, 0.15) << "no shorter than by a sample's distance";
}

/// A vessel beside the section, nearer than the reach, is another vessel's: no score changes.
TEST(LumenScores, ASideBranchNearbyDoesNotCount) {
  const geometry::TriMesh alone = tube(1.6);
  for (const double beside : {2.4, 2.9, 4.0}) {
    const SectionScore a = LumenResult(alone).score(cylinder(1.5));
    const SectionScore b =
        LumenResult(geometry::merged(alone, tube(0.6, Vec3(beside, 0.1, 0.0)))).score(cylinder(1.5));
    EXPECT_NEAR(b.dice, a.dice, 1e-9) << beside;
    EXPECT_NEAR(b.msd_mm, a.msd_mm, 1e-9) << beside;
    EXPECT_NEAR(b.max_sd_mm, a.max_sd_mm, 1e-9) << beside;
    EXPECT_NEAR(b.signed_mean_mm, a.signed_mean_mm, 1e-9) << beside;
  }
}

/// Two observers, each about the same tube: what one is against the other is the same both ways round.
TEST(LumenScores, ObserverAgainstObserver) {
  const ContourSection one = cylinder(1.5, 5.0, 15.0, 256), other = cylinder(1.6, 4.0, 16.0, 256, 0.3);
  const SectionScore s = LumenResult(surface_of(other)).score(one);
  EXPECT_NEAR(s.msd_mm, 0.1, 3e-4);
  EXPECT_NEAR(s.dice, 2.0 * 1.5 * 1.5 / (1.5 * 1.5 + 1.6 * 1.6), 1e-3);
  const ContourSection longer = cylinder(1.5, 4.0, 16.0, 256), shorter = cylinder(1.6, 5.0, 15.0, 256, 0.3);
  const SectionScore back = LumenResult(surface_of(longer)).score(shorter);
  EXPECT_NEAR(back.msd_mm, s.msd_mm, 1e-4);
  EXPECT_NEAR(back.dice, s.dice, 1e-3);
  EXPECT_NEAR(back.signed_mean_mm, -s.signed_mean_mm, 1e-3);
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
