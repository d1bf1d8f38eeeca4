#include "ostia/view/volume_cuts.h"

#include "ostia/core/error.h"
#include "ostia/geometry/carm_angles.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::view {
namespace {

imaging::Geometry oblique_grid_to_cut() {
  imaging::Geometry grid;
  grid.size = {41, 37, 29};
  grid.spacing = {0.9, 1.1, 1.7};
  grid.direction =
      (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(-0.6, Vec3::UnitZ())).toRotationMatrix();
  grid.origin = {12.0, -33.0, 7.0};
  return grid;
}

imaging::MaskVolume all_of(const imaging::Geometry& grid) {
  return {grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 1)};
}

VolumeCut cut_from(const geometry::CarmAngles& angles, std::vector<Vec2> outline, bool keep_inside) {
  const Vec3 towards = geometry::towards_receptor(angles), up = geometry::receptor_up(angles);
  return {up.cross(towards), up, std::move(outline), keep_inside};
}

/// Calls `each(voxel's value, its place in the picture)` for every voxel.
template <class Each>
void for_each_voxel(const imaging::MaskVolume& mask, const VolumeCut& cut, const Each& each) {
  const imaging::Geometry& grid = mask.geometry;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const Vec3 at = grid.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        each(mask(i, j, k), Vec2(at.dot(cut.right), at.dot(cut.up)));
      }
}

class SquareCut : public ::testing::TestWithParam<std::tuple<double, double, bool>> {};

TEST_P(SquareCut, TakesExactlyTheVoxelsThatAreSeenInIt) {
  const auto [lao, cranial, keep] = GetParam();
  const imaging::Geometry grid = oblique_grid_to_cut();
  const Vec3 middle = grid.world({20.0, 18.0, 14.0});
  VolumeCut cut = cut_from({lao, cranial}, {{0, 0}, {1, 0}, {1, 1}}, keep);
  const Vec2 at(middle.dot(cut.right) + 0.013, middle.dot(cut.up) + 0.029);
  constexpr double half = 8.0;
  cut.outline_mm = {at + Vec2(-half, -half), at + Vec2(half, -half), at + Vec2(half, half),
                    at + Vec2(-half, half)};
  imaging::MaskVolume mask = all_of(grid);
  cut_away(mask, cut);
  std::int64_t inside = 0, wrong = 0;
  for_each_voxel(mask, cut, [&](std::uint8_t value, const Vec2& seen) {
    const bool in = (seen - at).cwiseAbs().maxCoeff() < half;
    inside += in ? 1 : 0;
    wrong += (value != 0) == (in == keep) ? 0 : 1;
  });
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(wrong, 0);
}
INSTANTIATE_TEST_SUITE_P(Views, SquareCut,
                         ::testing::Combine(::testing::Values(0.0, 30.0, -47.0, 90.0),
                                            ::testing::Values(0.0, -25.0, 60.0), ::testing::Bool()));

TEST(VolumeCuts, ARowAlongTheViewIsInOrOutAsAWhole) {
  imaging::Geometry grid;
  grid.size = {20, 20, 20};
  imaging::MaskVolume mask = all_of(grid);
  // From the patient's left: rows run along the view. 10 x 6 voxels of y and z, all twenty along x.
  cut_away(mask, cut_from({90.0, 0.0}, {{4.5, 2.5}, {14.5, 2.5}, {14.5, 8.5}, {4.5, 8.5}}, false));
  std::int64_t gone = 0;
  for (std::int64_t k = 0; k < 20; ++k)
    for (std::int64_t j = 0; j < 20; ++j)
      for (std::int64_t i = 0; i < 20; ++i)
        if (mask(i, j, k) == 0) {
          ++gone;
          EXPECT_TRUE(j >= 5 && j <= 14 && k >= 3 && k <= 8);
        }
  EXPECT_EQ(gone, 20 * 10 * 6);
}

TEST(VolumeCuts, ARoundLineTakesARoundRod) {
  imaging::Geometry grid;
  grid.size = {60, 60, 20};
  grid.spacing = {0.5, 0.5, 1.0};
  imaging::MaskVolume mask = all_of(grid);
  constexpr int corners = 720;
  constexpr double radius = 9.0;
  const Vec2 middle(14.8, -15.1);  // right is x, up is -y: from the head
  std::vector<Vec2> line;
  for (int n = 0; n < corners; ++n) {
    const double at = 2.0 * std::numbers::pi * n / corners;
    line.emplace_back(middle + radius * Vec2(std::cos(at), std::sin(at)));
  }
  const VolumeCut cut{Vec3::UnitX(), -Vec3::UnitY(), line, false};
  cut_away(mask, cut);
  for_each_voxel(mask, cut, [&](std::uint8_t value, const Vec2& seen) {
    const double away = (seen - middle).norm();
    if (away < 0.9999 * radius) {
      EXPECT_EQ(value, 0);
    } else if (away > radius) {
      EXPECT_EQ(value, 1);
    }
  });
}

TEST(VolumeCuts, WhereTheLineCrossesItselfTheTwoHalvesAreIn) {
  imaging::Geometry grid;
  grid.size = {21, 3, 21};
  imaging::MaskVolume mask = all_of(grid);
  // An eight of two triangles that meet at (10, 10).
  cut_away(mask, {Vec3::UnitX(), Vec3::UnitZ(), {{0.1, 0.3}, {20.1, 20.2}, {20.1, 0.3}, {0.1, 20.2}}, false});
  EXPECT_EQ(mask(2, 1, 10), 0) << "left half";
  EXPECT_EQ(mask(18, 1, 10), 0) << "right half";
  EXPECT_EQ(mask(10, 1, 2), 1);
  EXPECT_EQ(mask(10, 1, 18), 1);
}

TEST(VolumeCuts, TwoCutsTakeWhatEitherTakes) {
  const imaging::Geometry grid = oblique_grid_to_cut();
  const VolumeCut a = cut_from({20.0, 10.0}, {{0, -40}, {30, -40}, {10, 20}}, false);
  const VolumeCut b = cut_from({-60.0, 0.0}, {{-20, 0}, {40, 5}, {0, 60}}, false);
  imaging::MaskVolume only_a = all_of(grid), only_b = all_of(grid), both = all_of(grid);
  cut_away(only_a, a);
  cut_away(only_b, b);
  cut_away(both, b);
  cut_away(both, a);
  for (std::size_t n = 0; n < both.voxels.size(); ++n)
    ASSERT_EQ(both.voxels[n], std::min(only_a.voxels[n], only_b.voxels[n]));
}

TEST(VolumeCuts, WhatIsNoLineIsRefused) {
  imaging::MaskVolume mask = all_of(oblique_grid_to_cut());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cut_away(mask, cut_from({}, {{0, 0}, {1, 0}}, false)), InvalidInput);
  EXPECT_THROW(cut_away(mask, cut_from({}, {{0, 0}, {1, 0}, {nan, 1}}, false)), InvalidInput);
  EXPECT_THROW(cut_away(mask, {Vec3::UnitX(), Vec3::UnitX(), {{0, 0}, {1, 0}, {1, 1}}, false}), InvalidInput);
  mask.voxels.pop_back();
  EXPECT_THROW(cut_away(mask, cut_from({}, {{0, 0}, {1, 0}, {1, 1}}, false)), InvalidInput);
}

TEST(VolumeCrops, AreAlongThePatientsAxes) {
  imaging::Geometry grid;
  grid.size = {101, 51, 21};
  // i runs to the head, j to the right, k to the back.
  grid.direction.col(0) = Vec3::UnitZ();
  grid.direction.col(1) = -Vec3::UnitX();
  grid.direction.col(2) = -Vec3::UnitZ().cross(Vec3::UnitX());
  grid.direction.col(2) = grid.direction.col(0).cross(grid.direction.col(1));
  const double back = grid.direction.col(2).y();
  ASSERT_NEAR(std::abs(back), 1.0, 1e-12);
  const IndexBox box = index_box({{0.1, 0.25, 0.5}, {0.6, 1.0, 0.9}}, grid);
  EXPECT_NEAR(box.low.x(), 50.0, 1e-9) << "from half its height";
  EXPECT_NEAR(box.high.x(), 90.0, 1e-9);
  EXPECT_NEAR(box.low.y(), 20.0, 1e-9) << "to the right: 1 - 0.6 of 50";
  EXPECT_NEAR(box.high.y(), 45.0, 1e-9);
  EXPECT_NEAR(box.low.z(), back > 0.0 ? 5.0 : 0.0, 1e-9);
  EXPECT_NEAR(box.high.z(), back > 0.0 ? 20.0 : 15.0, 1e-9);
  const IndexBox whole = index_box({}, oblique_grid_to_cut());
  EXPECT_EQ(whole.low, Vec3::Zero());
  EXPECT_EQ(whole.high, Vec3(40.0, 36.0, 28.0));
  EXPECT_THROW(index_box({{0.5, 0.0, 0.0}, {0.5, 1.0, 1.0}}, grid), InvalidInput);
  EXPECT_THROW(index_box({{-0.1, 0.0, 0.0}, {0.5, 1.0, 1.0}}, grid), InvalidInput);
}

TEST(MaskedVolume, IsAirOutsideTheSameInsideAndSoftBetween) {
  imaging::Geometry grid;
  grid.size = {12, 9, 8};
  imaging::ImageVolume image{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()), 300)};
  imaging::MaskVolume mask = all_of(grid);
  for (std::int64_t k = 0; k < 8; ++k)
    for (std::int64_t j = 0; j < 9; ++j)
      for (std::int64_t i = 6; i < 12; ++i) mask(i, j, k) = 0;
  const imaging::ImageVolume shown = with_mask(image, mask);
  for (std::int64_t i = 0; i <= 4; ++i) EXPECT_EQ(shown(i, 4, 4), 300);
  EXPECT_EQ(shown(5, 4, 4), std::lround(-1024.0 + 0.75 * 1324.0));
  EXPECT_EQ(shown(6, 4, 4), std::lround(-1024.0 + 0.25 * 1324.0));
  for (std::int64_t i = 7; i < 12; ++i) EXPECT_EQ(shown(i, 4, 4), -1024);
  mask.geometry.origin.x() += 1.0;
  EXPECT_THROW(with_mask(image, mask), InvalidInput);
}

}  // namespace
}  // namespace ostia::view
