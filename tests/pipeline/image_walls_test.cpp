#include "ostia/pipeline/image_walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double radius_mm = 1.5;

/// A bright lumen along z with a wall, in fat; perhaps with a thinner branch along x from its middle, perhaps
/// ending bluntly.
imaging::ImageVolume tube(double branch_radius_mm = 0.0, double end_mm = 1e3) {
  imaging::ImageVolume image;
  image.geometry.size = {40, 40, 80};
  image.geometry.spacing = {0.4, 0.4, 0.4};
  image.geometry.origin = {-7.8, -7.8, -1.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < 80; ++k)
    for (std::int64_t j = 0; j < 40; ++j)
      for (std::int64_t i = 0; i < 40; ++i) {
        const Vec3 at = image.geometry.world({double(i), double(j), double(k)});
        const double r = std::hypot(at.x(), at.y());
        const auto inside = [](double off_mm) { return std::clamp(0.5 - off_mm / 0.6, 0.0, 1.0); };
        const auto hu_at = [&](double off_mm, double radius, double beyond_mm) {
          const auto within = [&](double wall_mm) {
            return inside(off_mm - radius - wall_mm) * inside(beyond_mm - wall_mm);
          };
          return -80.0 + 130.0 * within(0.8) + 350.0 * within(0.0);
        };
        double hu = hu_at(r, radius_mm, at.z() - end_mm);
        if (branch_radius_mm > 0.0 && at.x() > 0.0)
          hu = std::max(hu, hu_at(std::hypot(at.y(), at.z() - 15.0), branch_radius_mm, -1e3));
        image(i, j, k) = static_cast<std::int16_t>(std::lround(hu));
      }
  return image;
}

geometry::Centerline line(const Vec3& from, const Vec3& to, double radius = radius_mm) {
  geometry::Centerline made;
  const int steps = static_cast<int>((to - from).norm() / 0.4);
  for (int i = 0; i <= steps; ++i) {
    made.points.push_back(from + (to - from) * i / steps);
    made.radius.push_back(radius);
  }
  geometry::complete(made);
  return made;
}

TEST(ImageWalls, ATakeOffIsAsWideAsItsBranch) {
  constexpr double branch_mm = 0.8;
  geometry::VesselTree tree;
  tree.nodes = {{0, {0, 0, 0}}, {1, {0, 0, 15}}, {2, {0, 0, 28}}, {3, {7.6, 0, 15}}};
  tree.segments = {{0, 0, 1, line({0, 0, 0}, {0, 0, 15})},
                   {1, 1, 2, line({0, 0, 15}, {0, 0, 28})},
                   {2, 1, 3, line({0, 0, 15}, {7.6, 0, 15}, branch_mm)}};
  tree.vessels = {{7, "LAD", {0, 1}}, {9, "D1", {0, 2}}};
  const auto walls = walls_from_image(tree, tube(branch_mm), core::no_task());
  ASSERT_EQ(walls.size(), 2U);
  // The whole axis of the branch has its parent's radius up to 15 mm.
  for (const double s : {15.0, 15.1, 15.3, 16.0, 17.0, 18.0, 20.0})
    for (const double theta : {0.0, 1.5, 3.0, 4.5}) EXPECT_NEAR(walls[1](s, theta), branch_mm, 0.25) << s;
}

TEST(ImageWalls, ABluntEndIsAsWideAsItsVessel) {
  geometry::VesselTree tree;
  tree.nodes = {{0, {0, 0, 0}}, {1, {0, 0, 24}}};
  tree.segments = {{0, 0, 1, line({0, 0, 0}, {0, 0, 24})}};
  tree.vessels = {{7, "LAD", {0}}};
  const auto walls = walls_from_image(tree, tube(0.0, 24.0), core::no_task());
  ASSERT_EQ(walls.size(), 1U);
  for (const double s : {20.0, 22.0, 22.5, 23.0, 23.5, 24.0})
    for (const double theta : {0.0, 1.5, 3.0, 4.5}) EXPECT_NEAR(walls[0](s, theta), radius_mm, 0.15) << s;
}

TEST(ImageWalls, WhatIsWrongIsSaidOfTheVesselThatItIsAbout) {
  geometry::VesselTree tree;
  tree.nodes = {{0, {0, 0, 0}}, {1, {0, 0, 15}}, {2, {0, 0, 28}}, {3, {2.5, 0, 16.5}}};
  tree.segments = {{0, 0, 1, line({0, 0, 0}, {0, 0, 15})},
                   {1, 1, 2, line({0, 0, 15}, {0, 0, 28})},
                   {2, 1, 3, line({0, 0, 15}, {2.5, 0, 16.5})}};
  tree.vessels = {{7, "LAD", {0, 1}}, {9, "D1", {0, 2}}};  // the branch ends within its parent's reach
  std::vector<std::vector<std::string>> said{{"from before"}};
  const auto walls = walls_from_image(tree, tube(), core::no_task(), &said);
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_NEAR(walls[0](20.0, 1.0), radius_mm, 0.25);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_THAT(said[0], IsEmpty());
  EXPECT_THAT(said[1], ElementsAre(HasSubstr("too short by itself")));
}

}  // namespace
}  // namespace ostia::pipeline
