#include "ostia/view/volume_scene.h"

#include "shown_scene.h"

#include "ostia/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <memory>
#include <ostream>

namespace ostia::view {

/// For the names of tests.
void PrintTo(VolumeMode mode, std::ostream* out) {
  *out << (mode == VolumeMode::mip ? "mip" : mode == VolumeMode::rendering ? "rendering" : "off");
}

namespace {

using geometry::Vec2;
using testing::Shot;
using testing::ShownScene;

/// 48 x 40 x 32 voxels, none of them cubes, along axes that are oblique to the world's.
imaging::Geometry oblique_grid() {
  imaging::Geometry grid;
  grid.size = {48, 40, 32};
  grid.spacing = {0.8, 1.0, 1.3};
  grid.direction = (Eigen::AngleAxisd(0.5, Vec3::UnitX()) * Eigen::AngleAxisd(-0.7, Vec3::UnitY()) *
                    Eigen::AngleAxisd(0.9, Vec3::UnitZ()))
                       .toRotationMatrix();
  grid.origin = {31.0, -17.0, 8.0};
  return grid;
}

/// Air with cubes of 3^3 voxels of a given HU about some voxels.
std::shared_ptr<imaging::ImageVolume> with_landmarks(const imaging::Geometry& grid,
                                                     const std::vector<std::array<int, 3>>& at,
                                                     std::int16_t hu, std::int16_t elsewhere = -900) {
  auto image = std::make_shared<imaging::ImageVolume>();
  image->geometry = grid;
  image->voxels.assign(static_cast<std::size_t>(grid.voxels()), elsewhere);
  for (const auto& c : at)
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) (*image)(c[0] + i, c[1] + j, c[2] + k) = hu;
  return image;
}

Vec3 centre_of(const imaging::Geometry& grid) {
  return grid.world({23.5, 19.5, 15.5});
}

/// The middle of what is brighter than the background, in pixels.
Vec2 bright_middle(const Shot& shot) {
  Vec2 sum = Vec2::Zero();
  double weight = 0.0;
  for (int y = 0; y < shot.height; ++y) {
    for (int x = 0; x < shot.width; ++x) {
      const double bright = shot.at(Vec2(x, y)).brightness() - shot.background().brightness() - 60;
      if (bright <= 0.0) continue;
      sum += bright * Vec2(x + 0.5, y + 0.5);
      weight += bright;
    }
  }
  return weight > 0.0 ? Vec2(sum / weight) : Vec2(-1.0, -1.0);
}

class ObliqueLandmark : public ::testing::TestWithParam<VolumeMode> {};

TEST_P(ObliqueLandmark, IsSeenWhereItsWorldPointIsProjected) {
  const imaging::Geometry grid = oblique_grid();
  ShownScene shown;
  shown.scene.set_volume_mode(GetParam());
  for (const std::array<int, 3> voxel : {std::array<int, 3>{40, 8, 5}, {10, 30, 26}, {24, 20, 3}}) {
    shown.scene.set_volume(with_landmarks(grid, {voxel}, 900));
    for (const ViewFrom side : {ViewFrom::anterior, ViewFrom::left, ViewFrom::caudal}) {
      shown.scene.set_pose(pose_from(side, centre_of(grid), 35.0));
      const Vec2 expected = shown.scene.project(grid.world(
          {static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2])}));
      const Vec2 seen = bright_middle(shown.shoot());
      EXPECT_NEAR((seen - expected).norm(), 0.0, 2.0)
          << "seen at " << seen.transpose() << ", it lies at " << expected.transpose();
    }
  }
}
INSTANTIATE_TEST_SUITE_P(VolumeSceneGui, ObliqueLandmark,
                         ::testing::Values(VolumeMode::rendering, VolumeMode::mip));

TEST(VolumeSceneGui, ModesShowWhatTheyShould) {
  const imaging::Geometry grid = oblique_grid();
  const Vec3 middle = grid.world({24.0, 20.0, 16.0});
  ShownScene shown;
  shown.scene.set_volume(with_landmarks(grid, {{24, 20, 16}}, 400, -80));
  shown.scene.set_pose(pose_from(ViewFrom::anterior, centre_of(grid), 35.0));
  EXPECT_EQ(shown.shoot().painted(), 0) << "the volume is off at first";
  shown.scene.set_volume_mode(VolumeMode::mip);
  const Vec2 at = shown.scene.project(middle), beside = at + Vec2(30.0, 20.0);
  const Shot mip = shown.shoot();
  EXPECT_GT(mip.at(at).brightness(), mip.background().brightness() + 150);
  EXPECT_LT(mip.at(beside).difference(mip.background()), 15) << "fat is transparent";
  shown.scene.set_volume_mode(VolumeMode::rendering);
  const Shot rendering = shown.shoot();
  EXPECT_GT(rendering.at(at).brightness(), rendering.background().brightness() + 60);
  EXPECT_LT(rendering.at(beside).difference(rendering.background()), 15);
  shown.scene.set_volume_look({VolumePreset::vessels, 1250.0, 1.0});  // nothing is as dense as that
  EXPECT_EQ(shown.shoot().painted(), 0);
  shown.scene.set_volume_look({});
  EXPECT_GT(shown.shoot().painted(), 100);
  shown.scene.set_volume(nullptr);
  EXPECT_EQ(shown.shoot().painted(), 0);
}

TEST(VolumeSceneGui, CalciumOutshinesContrastAndMuscleIsFaint) {
  const imaging::Geometry grid = oblique_grid();
  ShownScene shown;
  shown.scene.set_volume_mode(VolumeMode::rendering);
  shown.scene.set_pose(pose_from(ViewFrom::anterior, centre_of(grid), 35.0));
  std::array<int, 4> brightness{};
  for (std::size_t i = 0; i < 4; ++i) {
    constexpr std::array<std::int16_t, 4> hu{-80, 100, 400, 1000};
    shown.scene.set_volume(with_landmarks(grid, {{24, 20, 16}}, hu[i], -200));
    const Shot shot = shown.shoot();
    brightness[i] = shot.at(shown.scene.project(grid.world({24.0, 20.0, 16.0}))).brightness() -
                    shot.background().brightness();
  }
  EXPECT_NEAR(brightness[0], 0, 3);
  EXPECT_GT(brightness[1], brightness[0]);
  EXPECT_GT(brightness[2], 3 * brightness[1]);
  EXPECT_GT(brightness[3], brightness[2] + 40);
}

TEST(VolumeSceneGui, TheWallIsPickedThroughTheVolume) {
  const testing::Tree tree = testing::straight_tree();
  imaging::Geometry grid;
  grid.size = {40, 40, 50};
  grid.origin = {-20.0, -20.0, -5.0};
  auto heart = with_landmarks(grid, {}, 0, 400);
  ShownScene shown;
  shown.scene.set_wall(tree.wall, tree.model);
  shown.scene.set_volume(heart);
  shown.scene.set_volume_mode(VolumeMode::mip);
  shown.scene.set_pose(pose_from(ViewFrom::anterior, {0.0, 0.0, 20.0}, 30.0));
  shown.shoot();
  const auto pick = shown.scene.pick(shown.scene.project({0.5, 0.0, 14.0}));
  ASSERT_TRUE(pick && pick->vessel);
  EXPECT_NEAR(pick->s_mm, 14.0, 0.3);
  EXPECT_FALSE(shown.scene.pick(shown.scene.project({8.0, 0.0, 14.0})));
}

TEST(VolumeSceneGui, IsCoarseWhileTheCameraMovesAndThenGetsFiner) {
  const imaging::Geometry grid = oblique_grid();
  ShownScene shown;
  shown.scene.set_volume(with_landmarks(grid, {{24, 20, 16}, {10, 10, 10}}, 500, 60));
  shown.scene.set_volume_mode(VolumeMode::mip);
  shown.scene.set_pose(pose_from(ViewFrom::anterior, centre_of(grid), 35.0));
  EXPECT_FALSE(shown.scene.refine()) << "nothing is known before the first picture";
  const Shot first = shown.shoot();
  EXPECT_FALSE(shown.scene.refine(1e-6)) << "no finer picture is to be had in a nanosecond";
  EXPECT_THROW(shown.scene.refine(0.0), InvalidInput);
  int pictures = 0;
  Shot finest = first;
  while (shown.scene.refine(1e9)) {
    finest = shown.shoot();
    ++pictures;
  }
  EXPECT_EQ(pictures, 3);
  const auto differing = [](const Shot& a, const Shot& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      count += a.pixels[i].difference(b.pixels[i]) > 0 ? 1 : 0;
    return count;
  };
  EXPECT_GT(differing(first, finest), 500);
  shown.scene.set_interacting(true);
  EXPECT_FALSE(shown.scene.refine(1e9));
  EXPECT_GT(differing(shown.shoot(), finest), 500);
  shown.scene.set_interacting(false);
  shown.shoot();
  while (shown.scene.refine(1e9)) finest = shown.shoot();
  EXPECT_GT(finest.at(shown.scene.project(grid.world({24.0, 20.0, 16.0}))).brightness(),
            finest.background().brightness() + 150);
}

TEST(VolumeSceneGui, RefusesImagesThatCannotBeShown) {
  VolumeScene scene;
  auto image = with_landmarks(oblique_grid(), {}, 0);
  image->voxels.pop_back();
  EXPECT_THROW(scene.set_image(image), InvalidInput);
  imaging::Geometry flat = oblique_grid();
  flat.size = {48, 40, 1};
  EXPECT_THROW(scene.set_image(with_landmarks(flat, {}, 0)), InvalidInput);
  EXPECT_FALSE(scene.has_image());
  EXPECT_THROW(scene.set_window(100.0, -1.0), InvalidInput);
}

TEST(VolumeSceneGui, ABoxLeavesWhatIsInIt) {
  imaging::Geometry grid;
  grid.size = {60, 40, 50};
  grid.origin = {-30.0, -20.0, -25.0};
  ShownScene shown;
  shown.scene.set_volume_mode(VolumeMode::rendering);
  // One at the patient's right, one at the left, one low.
  shown.scene.set_volume(with_landmarks(grid, {{10, 20, 25}, {50, 20, 25}, {30, 20, 6}}, 900));
  shown.scene.set_pose(pose_from(ViewFrom::anterior, grid.world({29.5, 19.5, 24.5}), 35.0));
  const auto seen = [&](const std::array<int, 3>& voxel) {
    const Shot shot = shown.shoot();
    return shot.at(shown.scene.project(grid.world(Vec3(voxel[0], voxel[1], voxel[2]))))
               .difference(shot.background()) > 60;
  };
  EXPECT_TRUE(seen({10, 20, 25}) && seen({50, 20, 25}) && seen({30, 20, 6}));
  shown.scene.set_volume_crop({{0.0, 0.0, 0.3}, {0.5, 1.0, 1.0}});
  EXPECT_TRUE(seen({10, 20, 25}));
  EXPECT_FALSE(seen({50, 20, 25}));
  EXPECT_FALSE(seen({30, 20, 6}));
  shown.scene.set_volume_crop({});
  EXPECT_TRUE(seen({10, 20, 25}) && seen({50, 20, 25}) && seen({30, 20, 6}));
}

TEST(VolumeSceneGui, ALineOverThePictureCutsWhatLiesBehindIt) {
  imaging::Geometry grid;
  grid.size = {40, 40, 40};
  ShownScene shown;
  shown.scene.set_pose(pose_of_carm({35.0, -20.0}, grid.world({19.5, 19.5, 19.5}), 30.0));
  shown.shoot();
  const std::vector<Vec2> line{{150.0, 100.0}, {250.0, 110.0}, {240.0, 190.0}, {160.0, 180.0}};
  imaging::MaskVolume mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 1)};
  cut_away(mask, shown.scene.cut_along(line, false));
  const auto left_of = [](const Vec2& a, const Vec2& b, const Vec2& at) {
    return (b - a).x() * (at - a).y() - (b - a).y() * (at - a).x() > 0.0;
  };
  std::int64_t gone = 0;
  for (std::int64_t k = 0; k < 40; ++k)
    for (std::int64_t j = 0; j < 40; ++j)
      for (std::int64_t i = 0; i < 40; ++i) {
        const Vec2 at = shown.scene.project(
            grid.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
        bool inside = true;
        for (std::size_t n = 0; n < 4; ++n) inside = inside && left_of(line[n], line[(n + 1) % 4], at);
        gone += inside ? 1 : 0;
        ASSERT_EQ(mask(i, j, k), inside ? 0 : 1);
      }
  EXPECT_GT(gone, 1000);
  EXPECT_THROW(shown.scene.cut_along({{0.0, 0.0}, {1.0, 1.0}}, false), InvalidInput);
}

TEST(VolumeSceneGui, AnglesAndALineAreDrawnWhenTheyAreAskedFor) {
  ShownScene shown;
  EXPECT_EQ(shown.shoot().painted(), 0);
  shown.scene.set_angles_shown(true);
  const int letters = shown.shoot().painted();
  EXPECT_GT(letters, 20);
  shown.scene.set_lasso({{100.0, 100.0}, {200.0, 100.0}, {150.0, 180.0}});
  EXPECT_GT(shown.shoot().painted(), letters + 200);
  shown.scene.set_lasso({});
  EXPECT_EQ(shown.shoot().painted(), letters);
}

TEST(VolumeSceneGui, LightFromAllSidesDarkensWhereItIsLess) {
  imaging::Geometry grid;
  grid.size = {60, 40, 50};
  ShownScene shown;
  shown.scene.set_volume_mode(VolumeMode::rendering);
  const auto image = with_landmarks(grid, {{10, 20, 25}, {50, 20, 25}}, 900);
  shown.scene.set_volume(image);
  shown.scene.set_pose(pose_from(ViewFrom::anterior, grid.world({29.5, 19.5, 24.5}), 35.0));
  std::vector<float> light(image->voxels.size(), 1.0F);
  for (std::size_t n = 0; n < light.size(); ++n)
    if (static_cast<std::int64_t>(n) % 60 > 30) light[n] = 0.1F;  // at the patient's left
  shown.scene.set_volume_light(std::make_shared<const std::vector<float>>(light));
  const auto bright = [&](double i) {
    const Shot shot = shown.shoot();
    return shot.at(shown.scene.project(grid.world(Vec3(i, 20.0, 25.0)))).brightness() -
           shot.background().brightness();
  };
  const int dark = bright(50.0);
  EXPECT_GT(dark, 20) << "it is there";
  EXPECT_GT(bright(10.0), dark + 60);
  light.pop_back();
  EXPECT_THROW(shown.scene.set_volume_light(std::make_shared<const std::vector<float>>(light)), InvalidInput);
  shown.scene.set_volume_light(nullptr);
  EXPECT_GT(bright(50.0), dark + 60) << "the lamps alone make no difference";
}

}  // namespace
}  // namespace ostia::view
