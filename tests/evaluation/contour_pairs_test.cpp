#include "ostia/evaluation/contour_pairs.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/contour_surface.h"
#include "ostia/evaluation/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::evaluation {
namespace {

using std::numbers::pi;

std::vector<Vec3> circle(double radius, double z, int points = 64, const Vec3& middle = Vec3::Zero()) {
  std::vector<Vec3> out;
  for (int i = 0; i < points; ++i)
    out.push_back(middle +
                  Vec3(radius * std::cos(2 * pi * i / points), radius * std::sin(2 * pi * i / points), z));
  return out;
}

geometry::ContourSection tube(double radius, int contours, double step = 0.5) {
  geometry::ContourSection out;
  out.section = "s01";
  out.observer = "truth";
  for (int k = 0; k < contours; ++k) out.contours.push_back({step * k, circle(radius, step * k)});
  return out;
}

std::vector<std::vector<Vec3>> outlines(double radius, int contours, double step = 0.5) {
  std::vector<std::vector<Vec3>> out;
  for (int k = 0; k < contours; ++k) out.push_back(circle(radius, step * k, 80));
  return out;
}

TEST(ContourPairs, ConcentricCirclesDifferByTheirRadii) {
  const OutlineDifference d = compare_outlines({3.0, circle(1.5, 3.0, 256)}, circle(2.0, 3.0, 256));
  EXPECT_NEAR(d.mean_mm, 0.5, 1e-3);
  EXPECT_NEAR(d.max_mm, 0.5, 1e-3);
  EXPECT_NEAR(d.area_difference_mm2(), pi * (4.0 - 2.25), 3e-3);
  EXPECT_NEAR(d.dice, 2.0 * 2.25 / (4.0 + 2.25), 2e-3);
}

TEST(ContourPairs, ShiftedCirclesHaveTheLensTheyShare) {
  const double r = 2.0, shift = 1.0;
  const OutlineDifference d =
      compare_outlines({0.0, circle(r, 0.0, 256)}, circle(r, 0.0, 256, {shift, 0, 0}));
  const double lens =
      2 * r * r * std::acos(shift / (2 * r)) - shift / 2 * std::sqrt(4 * r * r - shift * shift);
  EXPECT_NEAR(d.dice, lens / (pi * r * r), 2e-3);
  EXPECT_NEAR(d.max_mm, shift, 0.01);
  EXPECT_NEAR(d.area_difference_mm2(), 0.0, 1e-9);
}

TEST(ContourPairs, EitherWayRoundIsTheSame) {
  std::vector<Vec3> back = circle(1.8, 0.0);
  std::reverse(back.begin(), back.end());
  const OutlineDifference a = compare_outlines({0.0, circle(1.5, 0.0)}, circle(1.8, 0.0));
  const OutlineDifference b = compare_outlines({0.0, circle(1.5, 0.0)}, back);
  EXPECT_NEAR(a.mean_mm, b.mean_mm, 1e-12);
  EXPECT_NEAR(a.dice, b.dice, 1e-12);
}

TEST(ContourPairs, RefusesWhatIsNoOutline) {
  EXPECT_THROW(compare_outlines({0.0, circle(1.0, 0.0)}, {Vec3::Zero(), Vec3::UnitX()}), InvalidInput);
  std::vector<Vec3> bad = circle(1.0, 0.0);
  bad[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compare_outlines({0.0, circle(1.0, 0.0)}, bad), InvalidInput);
}

TEST(RuledComparison, MeasuresTheDistanceOfTubes) {
  RuledComparison comparison(tube(1.5, 21));
  comparison.update(outlines(1.8, 21), {});
  EXPECT_NEAR(comparison.distances().mean_mm(), 0.3, 0.004);
  EXPECT_NEAR(comparison.distances().max_mm, 0.3, 0.01);
  EXPECT_NEAR(comparison.distances().area_mm2, 2 * pi * (1.5 + 1.8) * 10.0, 0.3);
  EXPECT_EQ(comparison.missing_mm(), 0.0);
}

TEST(RuledComparison, AgreesWithTheComparisonOfSurfaces) {
  const geometry::ContourSection truth = tube(1.5, 21);
  geometry::ContourSection other = truth;
  for (auto& c : other.contours) c.points = circle(1.5 + 0.3 * std::sin(c.s_mm), c.s_mm, 64, {0.2, 0.1, 0.0});
  std::vector<std::vector<Vec3>> lines;
  for (const auto& c : other.contours) lines.push_back(c.points);
  RuledComparison comparison(truth, {.sample_mm = 0.2});
  comparison.update(lines, {});
  SurfaceDistanceOptions how;
  how.sample_mm = 0.2;
  const SurfaceDistances whole = compare_surfaces(surface_of(truth), surface_of(other), how);
  EXPECT_NEAR(comparison.distances().mean_mm(), whole.msd_mm, 1e-9);
  EXPECT_NEAR(comparison.distances().max_mm, whole.max_sd_mm, 1e-9);
  EXPECT_NEAR(comparison.distances().rms_mm(), whole.rms_sd_mm, 1e-9);
}

TEST(RuledComparison, AnUpdateOfWhatChangedIsTheComparisonMadeAfresh) {
  auto lines = outlines(1.8, 41);
  RuledComparison kept(tube(1.5, 41));
  kept.update(lines, {});
  for (const std::size_t middle : {10U, 20U, 11U, 0U, 40U}) {
    std::vector<std::size_t> changed;
    for (std::size_t i = middle > 2 ? middle - 2 : 0; i <= std::min<std::size_t>(40, middle + 2); ++i) {
      lines[i] =
          circle(1.5 + 0.02 * static_cast<double>(i), 0.5 * static_cast<double>(i), 70, {0.4, 0.0, 0.0});
      changed.push_back(i);
    }
    kept.update(lines, changed);
    RuledComparison fresh(tube(1.5, 41));
    fresh.update(lines, {});
    EXPECT_EQ(kept.distances().sum, fresh.distances().sum) << middle;
    EXPECT_EQ(kept.distances().area_mm2, fresh.distances().area_mm2);
    EXPECT_EQ(kept.distances().max_mm, fresh.distances().max_mm);
  }
}

TEST(RuledComparison, LeavesOutWhereThereIsNoOutline) {
  auto lines = outlines(1.8, 21);
  lines[0].clear();
  lines[10].clear();
  RuledComparison comparison(tube(1.5, 21));
  comparison.update(lines, {});
  EXPECT_NEAR(comparison.missing_mm(), 1.5, 1e-12);
  EXPECT_NEAR(comparison.distances().area_mm2, 2 * pi * (1.5 + 1.8) * 8.5, 0.3);
  for (auto& line : lines) line.clear();
  comparison.update(lines, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20});
  EXPECT_TRUE(std::isnan(comparison.distances().mean_mm()));
  EXPECT_NEAR(comparison.missing_mm(), 10.0, 1e-12);
}

TEST(RuledComparison, RefusesOtherNumbersAndFaults) {
  RuledComparison comparison(tube(1.5, 5));
  EXPECT_THROW(comparison.update(outlines(1.8, 4), {}), InvalidInput);
  EXPECT_THROW(RuledComparison(tube(1.5, 1)), InvalidInput);
  EXPECT_THROW(RuledComparison(tube(1.5, 5), {.sample_mm = 0.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
