#include "ostia/pipeline/mask_walls.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

struct MaskTube {
  std::vector<Vec3> points;
  double radius_mm = 1.5;
};

std::vector<Vec3> straight(const Vec3& from, const Vec3& to) {
  std::vector<Vec3> points;
  const int steps = static_cast<int>((to - from).norm() / 0.5);
  for (int i = 0; i <= steps; ++i) points.push_back(from + (static_cast<double>(i) / steps) * (to - from));
  return points;
}

/// Voxels of 0.5 mm whose centres lie in a tube.
imaging::MaskVolume painted_tubes(const std::vector<MaskTube>& tubes) {
  imaging::MaskVolume mask;
  mask.geometry.size = {60, 60, 100};
  mask.geometry.spacing = {0.5, 0.5, 0.5};
  mask.geometry.origin = {-10.0, -15.0, -4.0};
  for (std::int64_t k = 0; k < 100; ++k)
    for (std::int64_t j = 0; j < 60; ++j)
      for (std::int64_t i = 0; i < 60; ++i) {
        const Vec3 at =
            mask.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        bool inside = false;
        for (const MaskTube& tube : tubes)
          inside =
              inside || (geometry::closest({tube.points.front(), tube.points.back()}, at).point - at).norm() <
                            tube.radius_mm;
        mask.voxels.push_back(inside ? 1 : 0);
      }
  return mask;
}

geometry::TreeSegment segment_of(std::int32_t id, std::int32_t from, std::int32_t to,
                                 const std::vector<Vec3>& points, double radius_mm) {
  geometry::TreeSegment segment{id, from, to, {}};
  segment.axis.points = points;
  segment.axis.radius.assign(points.size(), radius_mm);
  geometry::complete(segment.axis);
  return segment;
}

/// One vessel a line, each with a root of its own.
geometry::VesselTree lines_apart(const std::vector<MaskTube>& tubes) {
  geometry::VesselTree tree;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const auto n = static_cast<std::int32_t>(i);
    tree.nodes.push_back({2 * n + 1, tubes[i].points.front()});
    tree.nodes.push_back({2 * n + 2, tubes[i].points.back()});
    tree.segments.push_back(segment_of(n + 1, 2 * n + 1, 2 * n + 2, tubes[i].points, tubes[i].radius_mm));
    tree.vessels.push_back({n + 1, "V" + std::to_string(n + 1), {n + 1}});
  }
  return tree;
}

double mean_of(const lumen::RadialWall& wall, double s_mm) {
  double sum = 0.0;
  for (int k = 0; k < 36; ++k) sum += wall(s_mm, 2.0 * std::numbers::pi * k / 36.0) / 36.0;
  return sum;
}

TEST(MaskWalls, AFullTubeKeepsItsCalibre) {
  const std::vector<MaskTube> tubes{{straight({0, 0, 0}, {0, 0, 40}), 1.5}};
  const MaskWalls made = walls_from_mask(lines_apart(tubes), painted_tubes(tubes));
  ASSERT_EQ(made.walls.size(), 1U);
  for (double s = 2.0; s < 38.0; s += 1.0) EXPECT_NEAR(mean_of(made.walls[0], s), 1.5, 0.06) << s;
  EXPECT_TRUE(made.outside.empty());
}

TEST(MaskWalls, WhereABranchLeavesTheParentIsNotNarrower) {
  const Vec3 fork(0, 0, 15), branch_end = fork + 22.0 * Vec3(std::sin(0.6), 0, std::cos(0.6));
  const std::vector<MaskTube> tubes{{straight({0, 0, 0}, {0, 0, 40}), 2.0},
                                    {straight(fork, branch_end), 1.6}};
  geometry::VesselTree tree;
  tree.nodes = {{1, {0, 0, 0}}, {2, fork}, {3, {0, 0, 40}}, {4, branch_end}};
  tree.segments = {segment_of(1, 1, 2, straight({0, 0, 0}, fork), 2.0),
                   segment_of(2, 2, 3, straight(fork, {0, 0, 40}), 2.0),
                   segment_of(3, 2, 4, straight(fork, branch_end), 1.6)};
  tree.vessels = {{1, "V1", {1, 2}}, {2, "V2", {1, 3}}};
  const MaskWalls made = walls_from_mask(tree, painted_tubes(tubes));
  for (double s = 2.0; s < 38.0; s += 0.5) {
    EXPECT_GT(mean_of(made.walls[0], s), 1.8) << s;
    EXPECT_LT(mean_of(made.walls[0], s), 2.5) << s;
  }
  for (double s = 24.0; s < 36.0; s += 0.5) EXPECT_NEAR(mean_of(made.walls[1], s), 1.6, 0.12) << s;
}

TEST(MaskWalls, AGapIsAsWideAsItsEnds) {
  const std::vector<MaskTube> whole{{straight({0, 0, 0}, {0, 0, 40}), 1.5}};
  const std::vector<MaskTube> parts{{straight({0, 0, 0}, {0, 0, 16}), 1.5},
                                    {straight({0, 0, 24}, {0, 0, 40}), 1.5}};
  const MaskWalls made = walls_from_mask(lines_apart(whole), painted_tubes(parts));
  for (double s = 17.0; s < 24.0; s += 0.5) EXPECT_NEAR(mean_of(made.walls[0], s), 1.5, 0.25) << s;
}

TEST(MaskWalls, VesselsThatTouchArePartedAndOthersAreLeftAlone) {
  const double apart = 2.6;
  const std::vector<MaskTube> tubes{{straight({0, 0, 0}, {0, 0, 40}), 1.5},
                                    {straight({apart, 0, 0}, {apart, 0, 40}), 1.5}};
  MaskWallOptions options;
  const MaskWalls made = walls_from_mask(lines_apart(tubes), painted_tubes(tubes), options);
  const geometry::VesselTree tree = lines_apart(tubes);
  const geometry::Frame& frame = tree.segments[0].axis.frames[0];
  const double to_second = geometry::angle_of(frame, Vec3::UnitX()),
               to_first = geometry::angle_of(frame, -Vec3::UnitX());
  for (double s = 1.0; s < 39.0; s += 1.0) {
    EXPECT_LT(made.walls[0](s, to_second) + made.walls[1](s, to_first), apart - 0.8 * options.apart_mm) << s;
    EXPECT_GT(made.walls[0](s, to_second), 0.7) << s;
    EXPECT_NEAR(made.walls[0](s, to_first), 1.5, 0.3) << s;
  }
}

TEST(MaskWalls, WhatLiesOutsideIsCountedWithItsPlace) {
  const std::vector<MaskTube> tubes{{straight({0, 0, 0}, {0, 0, 40}), 1.5}};
  const MaskTube stub{straight({0, 0, 20}, {5, 0, 20}), 0.8};
  const MaskWalls made = walls_from_mask(lines_apart(tubes), painted_tubes({tubes[0], stub}));
  ASSERT_EQ(made.outside.size(), 1U);
  EXPECT_LT((made.outside[0].place - Vec3(5.2, 0, 20)).norm(), 1.5);
  EXPECT_GT(made.outside[0].volume_mm3, 4.0);
  EXPECT_LT(made.outside[0].volume_mm3, 9.0);
  EXPECT_GT(made.outside[0].length_mm, 2.5);
}

TEST(MaskWalls, BadInputIsNamed) {
  const std::vector<MaskTube> tubes{{straight({0, 0, 0}, {0, 0, 40}), 1.5}};
  imaging::MaskVolume mask = painted_tubes(tubes);
  MaskWallOptions options;
  options.apart_mm = -1.0;
  EXPECT_THROW(walls_from_mask(lines_apart(tubes), mask, options), InvalidInput);
  EXPECT_THROW(walls_from_mask({}, mask), InvalidInput);
  std::fill(mask.voxels.begin(), mask.voxels.end(), std::uint8_t{0});
  EXPECT_THROW(walls_from_mask(lines_apart(tubes), mask), InvalidInput);
}

}  // namespace
}  // namespace ostia::pipeline
