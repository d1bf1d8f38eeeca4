#include "ostia/analysis/calcium_score.h"

#include "calcium/calcium_spots.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::analysis {
namespace {

using imaging::ImageVolume;
using std::numbers::pi;

constexpr double calcium_background_hu = 40.0;

ImageVolume calcium_image(std::array<std::int64_t, 3> size, const Vec3& spacing,
                          const std::function<double(const Vec3&)>& hu_at) {
  ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = 0.5 * spacing;  // the field begins at 0
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu_at(image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))))));
  return image;
}

/// A cylinder along z with its length equal to its diameter, as calcium phantoms have them.
struct CalciumInsert {
  Vec3 centre;
  double diameter_mm, hu;
  /// Share of the pixel, by its corners and inside, times that of the slice's height.
  double share(const Vec3& at, const Vec3& spacing) const {
    const double low = std::max(at.z() - 0.5 * spacing.z(), centre.z() - 0.5 * diameter_mm);
    const double high = std::min(at.z() + 0.5 * spacing.z(), centre.z() + 0.5 * diameter_mm);
    if (high <= low) return 0.0;
    constexpr int pieces = 10;
    int inside = 0;
    for (int a = 0; a < pieces; ++a)
      for (int b = 0; b < pieces; ++b) {
        const double x = at.x() + ((a + 0.5) / pieces - 0.5) * spacing.x() - centre.x();
        const double y = at.y() + ((b + 0.5) / pieces - 0.5) * spacing.y() - centre.y();
        inside += std::hypot(x, y) < 0.5 * diameter_mm ? 1 : 0;
      }
    return inside / (1.0 * pieces * pieces) * (high - low) / spacing.z();
  }
};

ImageVolume insert_image(const CalciumInsert& insert, double slice_mm) {
  const Vec3 spacing(0.35, 0.35, slice_mm);
  const auto slices = static_cast<std::int64_t>(std::lround(24.0 / slice_mm));
  return calcium_image({48, 48, slices}, spacing, [&](const Vec3& at) {
    return calcium_background_hu + (insert.hu - calcium_background_hu) * insert.share(at, spacing);
  });
}

/// The definition, by hand: of each 3 mm slice the spots of pixels of 130 HU and more that touch by their
/// sides, of 1 mm2 and more, each its area times 1 to 4 by its brightest pixel.
double agatston_by_hand(const ImageVolume& image) {
  const auto nx = image.geometry.size[0], ny = image.geometry.size[1];
  const double pixel = image.geometry.spacing.x() * image.geometry.spacing.y();
  double score = 0.0;
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k) {
    std::vector<bool> seen(static_cast<std::size_t>(nx * ny), false);
    for (std::int64_t start = 0; start < nx * ny; ++start) {
      std::vector<std::int64_t> open{start};
      double area = 0.0;
      int peak = 0;
      while (!open.empty()) {
        const std::int64_t n = open.back();
        open.pop_back();
        const int hu = image(n % nx, n / nx, k);
        if (seen[static_cast<std::size_t>(n)] || hu < 130) continue;
        seen[static_cast<std::size_t>(n)] = true;
        area += pixel;
        peak = std::max(peak, hu);
        if (n % nx > 0) open.push_back(n - 1);
        if (n % nx < nx - 1) open.push_back(n + 1);
        if (n / nx > 0) open.push_back(n - nx);
        if (n / nx < ny - 1) open.push_back(n + nx);
      }
      if (area < 1.0) continue;
      score += area * (peak >= 400 ? 4 : peak >= 300 ? 3 : peak >= 200 ? 2 : 1);
    }
  }
  return score;
}

double agatston_of_all(const CalciumScore& score) {
  double sum = 0.0;
  for (const CalciumLesion& lesion : score.lesions) sum += lesion.amount.agatston;
  return sum;
}

TEST(CalciumScore, InsertsOfAllSizesDensitiesAndSlicesAreTheDefinitionOfTheTruth) {
  int counted = 0;
  for (const double diameter : {1.2, 2.0, 3.0, 5.0, 8.0})
    for (const double hu : {160.0, 250.0, 360.0, 700.0}) {
      const CalciumInsert insert{{8.36, 8.21, 11.2}, diameter, hu};
      const double truth = agatston_by_hand(insert_image(insert, 3.0));
      for (const double slice_mm : {3.0, 1.5, 1.0}) {
        const CalciumScore score = score_calcium(insert_image(insert, slice_mm)).score;
        const double found = agatston_of_all(score);
        EXPECT_NEAR(found, truth, 0.05 * truth) << diameter << " mm, " << hu << " HU, " << slice_mm << " mm";
        EXPECT_EQ(calcium_category(found), calcium_category(truth));
        counted += truth > 0.0 ? 1 : 0;
      }
    }
  EXPECT_GE(counted, 40);  // the smallest and faintest are nothing by the definition, too
}

TEST(CalciumScore, OfALargeInsertItIsItsAreaTimesItsWeight) {
  // Three slices long; pixels at its rim count from a share of (130 - 40) / (220 - 40) = 1/2 on.
  const CalciumInsert insert{{8.4, 8.4, 13.5}, 9.0, 220.0};
  const CalciumScore score = score_calcium(insert_image(insert, 3.0)).score;
  ASSERT_EQ(score.lesions.size(), 1U);
  const CalciumLesion& lesion = score.lesions[0];
  const double area = pi * 4.5 * 4.5;
  EXPECT_EQ(lesion.slices, 3);
  EXPECT_NEAR(lesion.amount.agatston, 3 * 2 * area, 0.02 * 6 * area);
  EXPECT_NEAR(lesion.amount.volume_mm3, 9.0 * area, 0.02 * 9.0 * area);
  EXPECT_NEAR(lesion.centre.z(), 13.5, 1e-6);
  EXPECT_NEAR(lesion.peak_hu, 220.0, 0.5);
}

ImageVolume block_of(double hu, std::int64_t wide, std::int64_t slices) {
  ImageVolume image = calcium_image({32, 32, 10}, {0.5, 0.5, 3.0}, [](const Vec3&) { return 40.0; });
  for (std::int64_t k = 3; k < 3 + slices; ++k)
    for (std::int64_t j = 8; j < 8 + wide; ++j)
      for (std::int64_t i = 8; i < 8 + wide; ++i) image(i, j, k) = static_cast<std::int16_t>(hu);
  return image;
}

TEST(CalciumScore, WeightsChangeAtTheirBounds) {
  const double area = 4.0;
  for (const auto& [hu, weight] : std::vector<std::pair<double, double>>{
           {129, 0}, {130, 1}, {199, 1}, {200, 2}, {299, 2}, {300, 3}, {399, 3}, {400, 4}, {1200, 4}})
    EXPECT_NEAR(agatston_of_all(score_calcium(block_of(hu, 4, 1)).score), area * weight, 1e-9) << hu;
}

TEST(CalciumScore, SpotsOfLessThanASquareMillimetreAreNothing) {
  EXPECT_TRUE(score_calcium(block_of(500, 1, 2)).score.lesions.empty());
  EXPECT_EQ(score_calcium(block_of(500, 2, 2)).score.lesions.size(), 1U);  // 1 mm2
}

TEST(CalciumScore, VolumeAndMassOfABlock) {
  CalciumOptions options;
  options.calibration = 0.8;
  const CalciumAmount amount = score_calcium(block_of(490, 4, 2), options).score.lesions.at(0).amount;
  EXPECT_NEAR(amount.volume_mm3, 4.0 * 6.0, 1e-9);
  EXPECT_NEAR(amount.mass_mg, 0.8 * 490.0 * 24.0 / 1000.0, 1e-9);
  // From 490 to 40 HU over 3 mm: 130 is reached after 0.8 of it, at both ends.
  EXPECT_NEAR(amount.interpolated_mm3, 4.0 * 3.0 * (1.0 + 2 * 0.8), 1e-9);
}

TEST(CalciumScore, OverlappingSlicesAreNotAveraged) {
  CalciumOptions options;
  options.slice_thickness_mm = 3.0;
  const ImageVolume image = calcium_image({32, 32, 20}, {0.5, 0.5, 1.5}, [](const Vec3& at) {
    return at.x() > 4 && at.x() < 6 && at.y() > 4 && at.y() < 6 && at.z() > 12 && at.z() < 18 ? 500.0 : 40.0;
  });
  const CalciumScore score = score_calcium(image, options).score;
  EXPECT_EQ(score.averaged, 1);
  EXPECT_NEAR(agatston_of_all(score), 4.0 * 4.0 * 4 * 0.5, 1e-9);  // four slices, each half of one
  ASSERT_FALSE(score.warnings.empty());
  EXPECT_NE(score.warnings[0].find("multiplied by 0.5"), std::string::npos) << score.warnings[0];
  EXPECT_EQ(score_calcium(image).score.averaged, 2);
}

TEST(CalciumScore, TheOrderOfTheAxesDoesNotMatter) {
  const CalciumInsert insert{{8.31, 8.12, 11.3}, 5.0, 360.0};
  const ImageVolume image = insert_image(insert, 3.0);
  ImageVolume turned;
  turned.geometry.size = {image.geometry.size[2], image.geometry.size[0], image.geometry.size[1]};
  turned.geometry.spacing = {3.0, 0.35, 0.35};
  turned.geometry.origin = image.geometry.origin;
  turned.geometry.direction.col(0) = Vec3::UnitZ();
  turned.geometry.direction.col(1) = Vec3::UnitX();
  turned.geometry.direction.col(2) = Vec3::UnitY();
  turned.voxels.resize(image.voxels.size());
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) turned(k, i, j) = image(i, j, k);
  const CalciumScore a = score_calcium(image).score, b = score_calcium(turned).score;
  ASSERT_EQ(b.lesions.size(), 1U);
  EXPECT_DOUBLE_EQ(a.lesions[0].amount.agatston, b.lesions[0].amount.agatston);
  EXPECT_LT((a.lesions[0].centre - b.lesions[0].centre).norm(), 1e-9);
}

TEST(CalciumScore, CategoriesAndCacDrs) {
  for (const auto& [score, words] : std::vector<std::pair<double, std::string>>{{0.0, "0"},
                                                                                {0.4, "1-10"},
                                                                                {10.0, "1-10"},
                                                                                {10.5, "11-100"},
                                                                                {100.0, "11-100"},
                                                                                {100.5, "101-400"},
                                                                                {400.0, "101-400"},
                                                                                {400.5, ">400"}})
    EXPECT_EQ(to_string(calcium_category(score)), words) << score;
  EXPECT_EQ(cac_drs(0.0, 0), "A0");
  EXPECT_EQ(cac_drs(99.0, 2), "A1/N2");
  EXPECT_EQ(cac_drs(100.0, 1), "A2/N1");
  EXPECT_EQ(cac_drs(299.4, 3), "A2/N3");
  EXPECT_EQ(cac_drs(299.9, 3), "A3/N3") << "reported as 300";
  EXPECT_EQ(cac_drs(300.0, 4), "A3/N4");
}

/// A ball of muscle and blood in lung, in a wall, with spots of calcium at places in the ball's radii.
constexpr double ball_mm = 45.0;
ImageVolume synthetic_chest(const std::vector<Vec3>& spots, double blood_hu = 45.0) {
  const Vec3 middle(80.0, 80.0, 66.0);
  return calcium_image({80, 80, 44}, {2.0, 2.0, 3.0}, [&](const Vec3& at) {
    for (const Vec3& spot : spots) {
      const Vec3 away = at - (middle + ball_mm * spot);
      if (std::hypot(away.x(), away.y()) < 3.0 && std::abs(away.z()) < 2.9) return 450.0;
    }
    const double from_heart = (at - middle).norm();
    if (from_heart < ball_mm) return blood_hu;
    if (from_heart < ball_mm + 9.0) return -90.0;  // fat, in which arteries lie
    return std::hypot(at.x() - 80.0, at.y() - 80.0) < 72.0 ? -850.0 : 50.0;
  });
}

TEST(CalciumScore, PlacesAreProposedByWhereTheyAreOnTheHeart) {
  const CalciumScore score =
      score_calcium(
          synthetic_chest({{0.8, -0.47, 0.46}, {0.28, 1.15, 0.9}, {-1.1, -0.1, -0.2}, {-0.55, 0.3, 0.5}}))
          .score;
  ASSERT_EQ(score.lesions.size(), 4U);
  EXPECT_GT(score.of(CalciumPlace::lad).agatston, 0.0);
  EXPECT_GT(score.of(CalciumPlace::lcx).agatston, 0.0);
  EXPECT_GT(score.of(CalciumPlace::rca).agatston, 0.0);
  EXPECT_GT(score.of(CalciumPlace::valve).agatston, 0.0);
  EXPECT_EQ(score.of(CalciumPlace::left_main).agatston, 0.0);
  EXPECT_EQ(score.vessels(), 3);
  double coronary = 0.0;
  for (std::size_t n = 0; n < coronary_places; ++n) coronary += score.by_place[n].agatston;
  EXPECT_DOUBLE_EQ(score.total.agatston, coronary);
  for (const CalciumLesion& lesion : score.lesions) {
    EXPECT_GT(lesion.confidence, 0.4);
    EXPECT_LE(lesion.confidence, 1.0);
  }
}

TEST(CalciumScore, APersonsWordCountsAndKeepsTheNumbers) {
  const CalciumScore before = score_calcium(synthetic_chest({{0.8, -0.47, 0.46}, {-1.1, -0.1, -0.2}})).score;
  ASSERT_EQ(before.lesions.size(), 2U);
  ASSERT_EQ(before.lesions[0].place, CalciumPlace::lad);
  const CalciumScore after = with_places(before, {{1, CalciumPlace::valve}});
  EXPECT_EQ(after.lesions[0].number, 1);
  EXPECT_TRUE(after.lesions[0].assigned);
  EXPECT_EQ(after.lesions[0].proposed, CalciumPlace::lad);
  EXPECT_DOUBLE_EQ(after.total.agatston, before.of(CalciumPlace::rca).agatston);
  EXPECT_THROW(with_places(before, {{3, CalciumPlace::lad}}), InvalidInput);
}

TEST(CalciumScore, ContrastAgentIsRefusedAndLittleIsTold) {
  EXPECT_THROW(score_calcium(synthetic_chest({}, 300.0)), InvalidInput);
  const CalciumScore some = score_calcium(synthetic_chest({}, 110.0)).score;
  ASSERT_FALSE(some.warnings.empty());
  EXPECT_NE(some.warnings.back().find("contrast"), std::string::npos);
  EXPECT_TRUE(score_calcium(synthetic_chest({})).score.warnings.empty());
}

TEST(CalciumScore, TheSameForAnyNumberOfThreads) {
  const ImageVolume image = synthetic_chest({{0.8, -0.47, 0.46}, {-1.1, -0.1, -0.2}});
  core::set_max_threads(1);
  const ScoredCalcium one = score_calcium(image);
  core::set_max_threads(4);
  const ScoredCalcium four = score_calcium(image);
  core::set_max_threads(0);
  EXPECT_EQ(one.lesion_numbers.voxels, four.lesion_numbers.voxels);
  EXPECT_EQ(one.score.total.agatston, four.score.total.agatston);
}

TEST(CalciumScore, FindingAndMeasuringAreCancelled) {
  const ImageVolume image = insert_image({{12.0, 12.0, 12.0}, 5.0, 400.0}, 3.0);
  const CalciumSlices slices = calcium_slices(image, {}, core::no_task());
  const CalciumSpots found = calcium_spots(slices, {}, core::no_task());
  ASSERT_EQ(measured_parts(slices, found, {}, core::no_task()).size(), 2U);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(calcium_spots(slices, {}, task), Cancelled);
  EXPECT_THROW(measured_parts(slices, found, {}, task), Cancelled);
  EXPECT_THROW(score_calcium(image, {}, task), Cancelled);
}

TEST(CalciumScore, WhatCannotBeScoredIsRefused) {
  const ImageVolume thick = calcium_image({32, 32, 10}, {0.5, 0.5, 8.0}, [](const Vec3&) { return 40.0; });
  EXPECT_THROW(score_calcium(thick), InvalidInput);
  EXPECT_THROW(score_calcium(calcium_image({32, 32, 1}, {0.5, 0.5, 3.0}, [](const Vec3&) { return 40.0; })),
               InvalidInput);
  CalciumOptions bad;
  bad.calibration = -1.0;
  EXPECT_THROW(score_calcium(block_of(500, 4, 2), bad), InvalidInput);
  EXPECT_THROW(calcium_place("LMCA"), InvalidInput);
  EXPECT_EQ(calcium_place("lad"), CalciumPlace::lad);
  EXPECT_EQ(calcium_place("none"), CalciumPlace::other);
}

}  // namespace
}  // namespace ostia::analysis
