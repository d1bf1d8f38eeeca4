// How far a wall may be off by what its image shows: the formula, and what makes it wider.

#include "ostia/analysis/wall_spread.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::analysis {
namespace {

/// Sections of a tube, half a millimetre apart.
std::vector<WallEvidence> tube_evidence(const std::function<double(double)>& radius_mm,
                                        double contrast_hu = 350.0, double blur_mm = 0.4) {
  std::vector<WallEvidence> all;
  for (int i = 0; i <= 40; ++i) {
    WallEvidence one;
    one.s_mm = 0.5 * i;
    one.calibre_mm = 2.0 * radius_mm(one.s_mm);
    one.lumen_hu = contrast_hu + 50.0;
    one.contrast_hu = contrast_hu;
    one.clear_share = 1.0;
    one.blur_mm = blur_mm;
    all.push_back(one);
  }
  return all;
}
const auto even = [](double) { return 1.5; };

TEST(WallSpread, OfAnEvenTubeIsItsFormula) {
  const WallSpreadModel model;
  const double noise = 30.0, contrast = 350.0, blur = 0.4, radius = 1.5;
  const auto found = radius_spreads_mm(tube_evidence(even), noise);
  const double ray = std::sqrt(2.0 * std::numbers::pi) * noise * blur / contrast;
  const double expected = model.scale * std::hypot(model.noise * ray * std::sqrt(blur / radius),
                                                   model.size * blur * blur / radius);
  ASSERT_EQ(found.size(), 41u);
  for (const double sd : found) EXPECT_NEAR(sd, expected, 1e-12);
  EXPECT_LT(expected, 0.05);
}

TEST(WallSpread, IsWiderWhereTheImageShowsLess) {
  const double usual = radius_spreads_mm(tube_evidence(even), 30.0)[20];
  EXPECT_GT(radius_spreads_mm(tube_evidence(even), 60.0)[20], usual);
  EXPECT_GT(radius_spreads_mm(tube_evidence(even, 150.0), 30.0)[20], usual);
  EXPECT_GT(radius_spreads_mm(tube_evidence(even, 350.0, 0.8), 30.0)[20], usual);
  EXPECT_GT(radius_spreads_mm(tube_evidence([](double) { return 0.6; }), 30.0)[20], usual);
  std::vector<WallEvidence> calcified = tube_evidence(even);
  calcified[20].calcium_share = 0.5;
  const auto beside = radius_spreads_mm(calcified, 30.0);
  EXPECT_GT(beside[20], 2.0 * usual);
  EXPECT_EQ(beside[10], usual);
}

TEST(WallSpread, IsWiderWhereALumenChanges) {
  const auto steep = [](double s) { return 1.5 - 0.06 * s; };
  const auto throat = [](double s) {
    const double t = (s - 10.0) / 6.0;
    return std::abs(t) < 0.5 ? 1.5 - 0.5 * (1.0 + std::cos(2.0 * std::numbers::pi * t)) * 0.4 : 1.5;
  };
  const double usual = radius_spreads_mm(tube_evidence(even), 30.0)[20];
  // Half way down the tube is as wide as the even one would be there: what is more is the slope's.
  const auto level = [](double) { return 0.9; };
  EXPECT_GT(radius_spreads_mm(tube_evidence(steep), 30.0)[20],
            radius_spreads_mm(tube_evidence(level), 30.0)[20]);
  EXPECT_GT(radius_spreads_mm(tube_evidence(throat), 30.0)[20], 1.5 * usual);
  EXPECT_NEAR(radius_spreads_mm(tube_evidence(throat), 30.0)[2], usual, 1e-12);
}

/// A narrow lumen is dim: its own contrast says nothing of its edge.
TEST(WallSpread, TakesContrastAndBlurFromTheSectionsAbout) {
  std::vector<WallEvidence> dim = tube_evidence(even);
  dim[20].contrast_hu = 40.0;
  dim[20].blur_mm = 0.0;
  EXPECT_NEAR(radius_spreads_mm(dim, 30.0)[20], radius_spreads_mm(tube_evidence(even), 30.0)[20], 1e-12);
}

TEST(WallSpread, IsTheMostWhereNothingIsSeen) {
  const WallSpreadModel model;
  std::vector<WallEvidence> some = tube_evidence(even);
  some[3].in_image = false;
  some[30].calibre_mm = 0.0;
  const auto found = radius_spreads_mm(some, 30.0);
  EXPECT_EQ(found[3], model.most_mm);
  EXPECT_EQ(found[30], model.most_mm);
  EXPECT_EQ(radius_spreads_mm(tube_evidence(even), 1e6)[20], model.most_mm);
  EXPECT_TRUE(radius_spreads_mm({}, 30.0).empty());
}

TEST(WallSpread, RefusesWhatIsNoModel) {
  WallSpreadModel model;
  model.slope = -1.0;
  EXPECT_THROW(radius_spreads_mm({}, 30.0, model), InvalidInput);
  model = {};
  model.most_mm = 2.0;
  EXPECT_THROW(radius_spreads_mm({}, 30.0, model), InvalidInput);
  model = {};
  model.reach_mm = std::nan("");
  EXPECT_THROW(radius_spreads_mm({}, 30.0, model), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
