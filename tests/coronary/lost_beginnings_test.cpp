#include "artery_scene.h"
#include "search_image.h"

#include "ostia/core/error.h"
#include "ostia/coronary/tree_growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ostia::coronary {
namespace {

using testing::Tube;

/// An upright aorta, an artery from its wall, and what begins `gap_mm` beyond it on the other side.
struct RootScene {
  static constexpr double aorta_mm = 9.0;
  double gap_mm = 6.0, other_hu = testing::contrast_hu;
  std::vector<Tube> open{{{-12.0, 9.0, 22.0}, {18.0, 24.0, 30.0}, 1.5}};
  std::vector<Tube> other;

  RootScene() {
    const Vec3 begin = wall() + gap_mm * Vec3(0.0, -1.0, 0.0);
    other = {{begin, {4.0, -22.0, 18.0}, 1.6}, {{4.0, -22.0, 18.0}, {26.0, -14.0, 8.0}, 1.3}};
  }
  static Vec3 wall() { return {-12.0, -aorta_mm, 20.0}; }
  static double inside(const std::vector<Tube>& tubes, const Vec3& at) {
    double most = 0.0;
    for (const Tube& tube : tubes) most = std::max(most, ostia::testing::ramp(tube.distance(at), 0.6));
    return most;
  }
  imaging::ImageVolume image() const {
    return ostia::testing::made_image(28.0, 44.0, 0.7, [&](const Vec3& at) {
      const Tube aorta{{-12.0, 0.0, -20.0}, {-12.0, 0.0, 70.0}, aorta_mm};
      const double blood = std::max(inside({aorta}, at), inside(open, at));
      return std::max(testing::fat_hu + (testing::contrast_hu - testing::fat_hu) * blood,
                      testing::fat_hu + (other_hu - testing::fat_hu) * inside(other, at));
    });
  }
  static Aorta aorta() {
    Aorta made;
    made.lumen_hu = testing::contrast_hu;
    for (double z = 4.0; z <= 40.0; z += 2.0)
      made.stations.push_back({{-12.0, 0.0, z}, Vec3::UnitZ(), aorta_mm, 1.0});
    return made;
  }
  std::vector<Ostium> ostia() const {
    Ostium made;
    made.place = open.front().from;
    made.direction = (open.front().to - open.front().from).normalized();
    return {made};
  }
  GrownTree grown(const GrowthOptions& options = {}) const {
    return grow_tree(image(), aorta(), ostia(), options);
  }
};

TEST(LostBeginnings, AnArteryBehindAClosedOstiumIsFound) {
  const RootScene scene;
  const GrownTree tree = scene.grown();
  ASSERT_EQ(tree.lost.size(), 1U);
  EXPECT_NEAR(tree.lost[0].beyond_mm, scene.gap_mm - scene.other[0].radius_mm, 0.6) << "its end is round";
  EXPECT_LT((tree.lost[0].place - scene.other[0].from).norm(), 2.0);
  EXPECT_GT(tree.lost[0].direction.dot((scene.other[0].to - scene.other[0].from).normalized()), 0.9);
  const auto its = std::find_if(tree.branches.begin(), tree.branches.end(),
                                [](const GrownBranch& branch) { return branch.ostium == 1; });
  ASSERT_NE(its, tree.branches.end());
  EXPECT_EQ(its->parent, -1);
  EXPECT_LT((its->points.back() - scene.other[1].to).norm(), 2.0);

  GrowthOptions options;
  options.farthest_beginning_mm = 3.0;
  EXPECT_TRUE(scene.grown(options).lost.empty()) << "farther away than is looked";
  options.farthest_beginning_mm = 0.0;
  EXPECT_TRUE(scene.grown(options).lost.empty());
}

TEST(LostBeginnings, WithoutAnyOstiumTheTreesAreFoundAllTheSame) {
  RootScene scene;
  scene.open[0].from += 4.0 * Vec3(0.8, 0.6, 0.0);
  const GrownTree tree = grow_tree(scene.image(), RootScene::aorta(), {});
  ASSERT_EQ(tree.lost.size(), 2U);
  EXPECT_EQ(tree.branches[0].ostium, 0U);
}

TEST(LostBeginnings, WhatIsNoArteryIsNone) {
  RootScene vein;
  vein.other_hu = 200.0;
  EXPECT_TRUE(vein.grown().lost.empty()) << "fainter";
  RootScene stub;
  stub.other = {{stub.other[0].from, stub.other[0].from + Vec3(12.0, -6.0, 0.0), 1.6}};
  EXPECT_TRUE(stub.grown().lost.empty()) << "short";
  RootScene passing;
  passing.other = {{{-26.0, -15.0, 20.0}, {26.0, -15.0, 20.0}, 1.6}};
  EXPECT_TRUE(passing.grown().lost.empty()) << "it passes by";
  RootScene wide;
  wide.other[0].radius_mm = wide.other[1].radius_mm = 4.2;
  EXPECT_TRUE(wide.grown().lost.empty()) << "wider than a coronary artery";
}

TEST(LostBeginnings, NoneIsSoughtWhereTwoTreesLeaveTheAorta) {
  RootScene scene;
  scene.open.push_back({{-3.0, 0.0, 30.0}, {26.0, 2.0, 34.0}, 1.5});
  std::vector<Ostium> ostia = scene.ostia();
  ostia.push_back(ostia.front());
  ostia.back().place = scene.open.back().from;
  ostia.back().direction = Vec3::UnitX();
  EXPECT_TRUE(grow_tree(scene.image(), RootScene::aorta(), ostia).lost.empty());
}

imaging::ImageVolume noisy(imaging::ImageVolume image, double sd_hu) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, sd_hu);
  for (std::int16_t& voxel : image.voxels)
    voxel = static_cast<std::int16_t>(std::lround(voxel + normal(random)));
  return image;
}

TEST(SearchImage, NoiseIsMeasuredInTheAortaAndSmoothed) {
  const imaging::ImageVolume clean = RootScene().image();
  const Aorta aorta = RootScene::aorta();
  EXPECT_LT(aortic_noise_hu(clean, aorta), 1.0);
  const imaging::ImageVolume loud = noisy(clean, 100.0);
  EXPECT_NEAR(aortic_noise_hu(loud, aorta), 100.0, 15.0);  // the lower quartile of small sections
  EXPECT_FALSE(search_image(noisy(clean, 40.0), aorta).changed.has_value());
  const SearchImage smooth = search_image(loud, aorta);
  ASSERT_TRUE(smooth.changed.has_value());
  EXPECT_NEAR(smooth.noise_hu, 75.0, 12.0);
  EXPECT_LT(aortic_noise_hu(*smooth.changed, aorta), 0.6 * smooth.noise_hu);
  ASSERT_EQ(smooth.warnings.size(), 1U);
}

TEST(SearchImage, ThickSlicesGetOthersBetweenThem) {
  imaging::ImageVolume image;
  image.geometry.size = {40, 40, 15};
  image.geometry.spacing = {0.7, 0.7, 2.0};
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n)
    image.voxels.push_back(static_cast<std::int16_t>(20 * (n / (40 * 40))));
  Aorta aorta = RootScene::aorta();
  const SearchImage fine = search_image(image, aorta);
  ASSERT_TRUE(fine.changed.has_value());
  EXPECT_EQ(fine.changed->geometry.size[2], 29);
  EXPECT_DOUBLE_EQ(fine.changed->geometry.spacing.z(), 1.0);
  for (std::int64_t k = 2; k < 27; ++k) EXPECT_EQ((*fine.changed)(20, 20, k), 10 * k);
  image.geometry.spacing.z() = 0.9;
  EXPECT_FALSE(search_image(image, aorta).changed.has_value());
}

}  // namespace
}  // namespace ostia::coronary
