#include "coarse_scan.h"
#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/coronary/heart_region.h"
#include "ostia/phantom/scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <limits>

namespace ostia::coronary {
namespace {

using phantom::Label;

/// Of each label how many voxels there are, and how many of them are shown.
struct ShownShares {
  std::array<double, 64> all{}, shown{};
  double share(Label label) const {
    const auto n = static_cast<std::size_t>(label);
    return all[n] > 0.0 ? shown[n] / all[n] : 1.0;
  }
  double count(Label label) const { return all[static_cast<std::size_t>(label)]; }
};

struct SyntheticChest {
  phantom::CasePlan plan;
  phantom::Scan scan;
  std::vector<ArteryPlace> arteries;

  explicit SyntheticChest(std::uint64_t seed) {
    constexpr double voxel_mm = 1.2;  // as fine as a volume in 3D is
    phantom::CaseOptions options;
    options.seed = seed;
    options.preset = phantom::Preset::small;
    plan = phantom::plan_case(options);
    ostia::testing::make_coarse(plan.options.scan, voxel_mm);
    scan = ostia::testing::kept_scan(plan);
    for (const phantom::CoronaryVessel& vessel : plan.tree.vessels)
      for (std::size_t n = 0; n < vessel.axis.size(); ++n)
        if (scan.image.geometry.contains(vessel.axis.points[n]))
          arteries.push_back({vessel.axis.points[n], vessel.axis.radius[n]});
  }
  ShownShares shares(const imaging::MaskVolume& mask) const {
    ShownShares shares;
    for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
      shares.all[scan.labels.voxels[n]] += 1.0;
      if (mask.voxels[n] != 0) shares.shown[scan.labels.voxels[n]] += 1.0;
    }
    return shares;
  }
};

class HeartRegion : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(HeartRegion, HasTheHeartAndNoBonesInAPhantom) {
  const SyntheticChest chest(GetParam());
  const ShownShares shown = chest.shares(heart_region(chest.scan.image, chest.arteries));
  for (std::size_t n = 0; n < shown.all.size(); ++n)
    if (shown.all[n] > 0.0)
      std::printf("label %2zu: %8.0f voxels, %6.2f %% shown\n", n, shown.all[n],
                  100.0 * shown.shown[n] / shown.all[n]);
  ASSERT_GT(shown.count(Label::bone), 1000.0);
  ASSERT_GT(shown.count(Label::coronary_lumen), 0.0);
  EXPECT_LE(shown.share(Label::bone), 0.01);
  EXPECT_LE(shown.share(Label::marrow), 0.01);
  for (const Label label :
       {Label::coronary_lumen, Label::soft_plaque, Label::fibrous_plaque, Label::calcified_plaque})
    EXPECT_EQ(shown.share(label), 1.0) << static_cast<int>(label);
  for (const Label label : {Label::left_ventricle, Label::right_ventricle, Label::left_atrium,
                            Label::right_atrium, Label::myocardium}) {
    EXPECT_GT(shown.count(label), 0.0) << static_cast<int>(label);
    EXPECT_GT(shown.share(label), 0.95) << static_cast<int>(label);
  }
  EXPECT_LT(shown.share(Label::liver), 0.2);
  EXPECT_LT(shown.share(Label::pulmonary_vessel), 0.2);
}
INSTANTIATE_TEST_SUITE_P(Seeds, HeartRegion, ::testing::Values(2U, 5U));

TEST(HeartRegionInput, WithoutArteriesOnlyTheBonesGo) {
  const SyntheticChest chest(2);
  const ShownShares shown = chest.shares(heart_region(chest.scan.image, {}));
  EXPECT_LT(shown.share(Label::bone), 0.2);
  EXPECT_GT(shown.share(Label::lung), 0.98) << "but for what touches a bone";
  EXPECT_GT(shown.share(Label::left_ventricle), 0.99);
}

TEST(HeartRegionInput, WhatIsNoPlaceOfAnArteryIsRefused) {
  imaging::ImageVolume image;
  image.geometry.size = {20, 20, 20};
  image.voxels.assign(8000, 40);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(heart_region({}, {}), InvalidInput);
  EXPECT_THROW(heart_region(image, {{Vec3(nan, 0.0, 0.0), 1.0}}), InvalidInput);
  EXPECT_THROW(heart_region(image, {{Vec3(5.0, 5.0, 5.0), nan}}), InvalidInput);
  EXPECT_THROW(heart_region(image, {{Vec3(500.0, 5.0, 5.0), 1.0}}), InvalidInput);
  HeartRegionOptions options;
  options.about_tree = -1.0;
  EXPECT_THROW(heart_region(image, {}, options), InvalidInput);
}

TEST(HeartRegionInput, OfAnEvenImageTheBallsAboutTheArteriesAreThere) {
  imaging::ImageVolume image;
  image.geometry.size = {30, 30, 30};
  image.voxels.assign(27000, 40);
  HeartRegionOptions options;
  options.about_tree = 0.0;
  options.blood = 0.0;
  options.about_artery = 3.0;
  const imaging::MaskVolume mask = heart_region(image, {{Vec3(12.0, 14.0, 16.0), 2.0}}, options);
  for (std::int64_t k = 0; k < 30; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 30; ++i) {
        const Vec3 at(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        EXPECT_EQ(mask(i, j, k), (at - Vec3(12.0, 14.0, 16.0)).norm() <= 5.0 ? 1 : 0);
      }
}

}  // namespace
}  // namespace ostia::coronary
