#include "ostia/pipeline/skeleton.h"

#include "support/masks.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

using centerline::test::to_segment;

/// Whatever lies within `radius` of one of the stretches.
struct Stretch {
  Vec3 from, to;
  double radius;
};
imaging::MaskVolume mask_of(const std::vector<Stretch>& stretches) {
  imaging::Geometry grid = centerline::test::grid_of(100, 100, 120, {0.4, 0.4, 0.4});
  grid.origin = {-20.0, -20.0, 0.0};
  return centerline::test::mask_of(grid, [&](const Vec3& at) {
    return std::any_of(stretches.begin(), stretches.end(),
                       [&](const Stretch& one) { return to_segment(at, one.from, one.to) <= one.radius; });
  });
}

const std::vector<Stretch> fork{
    {{0, 0, 4}, {0, 0, 22}, 2.0}, {{0, 0, 22}, {-9, 0, 42}, 1.5}, {{0, 0, 22}, {9, 0, 42}, 1.5}};

TEST(PipelineSkeleton, AForkIsThreeLinesTwoVesselsAndItsRadii) {
  SkeletonOptions options;
  options.inlets = {{0.0, 0.0, 3.0}};
  const SkeletonResult result = skeleton_of(mask_of(fork), nullptr, options);
  EXPECT_EQ(result.components, 1);
  EXPECT_EQ(result.loops, 0);
  EXPECT_EQ(result.skeleton.graph.edges.size(), 3U);
  ASSERT_EQ(result.tree.tree.vessels.size(), 2U);
  // Rounded ends: the object goes a radius beyond each stretch.
  EXPECT_NEAR(result.length_mm, 18.0 + 2.0 + 2.0 * (std::hypot(9.0, 20.0) + 1.5), 2.0);
  for (const geometry::TreeSegment& segment : result.tree.tree.segments) {
    const auto& line = segment.axis;
    const std::size_t middle = line.points.size() / 2;
    const bool trunk = line.points[middle].z() < 22.0;
    EXPECT_NEAR(line.radius[middle], trunk ? 2.0 : 1.5, 0.2);
    double off = 1e9;
    for (const Stretch& one : fork) off = std::min(off, to_segment(line.points[middle], one.from, one.to));
    EXPECT_LT(off, 0.25);
  }
  for (const std::string& warning : result.warnings) EXPECT_EQ(warning.find("inlet"), std::string::npos);
}

TEST(PipelineSkeleton, ALoopIsCountedAndOpenedAndAGuessedInletIsSaid) {
  std::vector<Stretch> ring = fork;
  ring.push_back({{-9, 0, 42}, {9, 0, 42}, 1.5});
  const SkeletonResult result = skeleton_of(mask_of(ring), nullptr);
  EXPECT_EQ(result.loops, 1);
  EXPECT_EQ(result.tree.opened_edges.size(), 1U);
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("loop")));
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("no inlet was given")));
}

TEST(PipelineSkeleton, LinesAreCutRemovedAndConnectedByHand) {
  std::vector<Stretch> apart = fork;
  apart.push_back({{-15, 0, 6}, {-15, 0, 30}, 1.5});
  const imaging::MaskVolume mask = mask_of(apart);
  ASSERT_EQ(skeleton_of(mask, nullptr).components, 2);
  SkeletonOptions options;
  options.commands.connections = {{Vec3(-15.0, 0.0, 4.6), Vec3(0.0, 0.0, 8.0)}};
  const SkeletonResult joined = skeleton_of(mask, nullptr, options);
  EXPECT_EQ(joined.components, 1);
  EXPECT_EQ(joined.tree.tree.vessels.size(), 3U);
  options.commands = {};
  options.commands.cuts = {Vec3(0.0, 0.5, 12.0)};
  EXPECT_EQ(skeleton_of(mask, nullptr, options).components, 3);
  // Without its lower half the trunk is what is left above the cut.
  options.commands.removals = {Vec3(0.0, 0.0, 6.0), Vec3(-15.0, 0.0, 20.0)};
  const SkeletonResult less = skeleton_of(mask, nullptr, options);
  EXPECT_EQ(less.components, 1);
  EXPECT_EQ(less.skeleton.graph.edges.size(), 3U);
  EXPECT_NEAR(less.length_mm, 10.0 + 2.0 * (std::hypot(9.0, 20.0) + 1.5), 2.0);
  options.commands = {};
  options.commands.cuts = {Vec3(30.0, 0.0, 12.0)};
  EXPECT_THROW(skeleton_of(mask, nullptr, options), InvalidInput);
}

TEST(PipelineSkeleton, TheFlowGoesFromTheInletAlsoWhereItsEndWasExtended) {
  SkeletonOptions options;
  options.inlets = {{0.0, 0.0, 3.0}};
  const SkeletonResult result = skeleton_of(mask_of(fork), nullptr, options);
  for (const auto& edge : result.skeleton.graph.edges)
    EXPECT_LT(edge.points.front().z(), edge.points.back().z());
  EXPECT_TRUE(result.skeleton.graph.oriented);
}

TEST(PipelineSkeleton, TheTableHasALineForEachPoint) {
  const SkeletonResult result = skeleton_of(mask_of({fork[0]}), nullptr);
  std::size_t points = 0;
  for (const auto& edge : result.skeleton.graph.edges) points += edge.points.size();
  std::istringstream rows(sections_csv(result.skeleton));
  std::string row;
  std::size_t lines = 0;
  while (std::getline(rows, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 15) << row;
    ++lines;
  }
  EXPECT_EQ(lines, points + 1);
}

TEST(PipelineSkeleton, RefusesWhatHasNoLinesAndCanBeCancelled) {
  const auto refusal = [](const imaging::MaskVolume& mask, const SkeletonOptions& options) -> std::string {
    try {
      skeleton_of(mask, nullptr, options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(refusal(mask_of({}), {}), HasSubstr("no object"));
  SkeletonOptions long_leaves;
  long_leaves.prune.length_mm = 500.0;
  EXPECT_THAT(refusal(mask_of({fork[0]}), long_leaves), HasSubstr("prune less"));
  SkeletonOptions far;
  far.inlets = {{100.0, 0.0, 0.0}};
  EXPECT_THAT(refusal(mask_of(fork), far), HasSubstr("mm"));
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(skeleton_of(mask_of(fork), nullptr, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::pipeline
