#include "ostia/centerline/tree_builder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

Axis path_through(const std::vector<Vec3>& corners) {
  Axis axis{corners, std::vector<double>(corners.size(), 1.0)};
  return at_equal_steps(axis, 0.1);
}

// A trunk along z to 10, branches to either side from there; the second path runs beside the first by a
// little.
std::vector<Axis> y_paths() {
  return {path_through({{0, 0, 0}, {0, 0, 10}, {8, 0, 16}}),
          path_through({{0, 0, 0}, {0.05, 0, 1}, {0.05, 0, 9.9}, {-8, 0, 15}})};
}

TEST(TreeBuilder, a_y_has_three_segments_and_shared_points) {
  const ChainTree chains = merge_paths(y_paths(), {0, 1}, 0.15);
  ASSERT_EQ(chains.chains.size(), 2u);
  const geometry::VesselTree tree = split_tree(chains, 0.1, {"a", "b"}).tree;
  EXPECT_FALSE(geometry::find_fault(tree).has_value()) << *geometry::find_fault(tree);
  EXPECT_EQ(tree.segments.size(), 3u);
  EXPECT_EQ(tree.nodes.size(), 4u);
  EXPECT_EQ(tree.vessels[1].name, "b");
  const geometry::Centerline a = geometry::vessel_axis(tree, tree.vessels[0]),
                             b = geometry::vessel_axis(tree, tree.vessels[1]);
  std::size_t shared = 0;
  while (a.points[shared] == b.points[shared]) ++shared;
  EXPECT_NEAR(a.abscissa[shared], 10.0, 0.5);
  EXPECT_NEAR((a.points.back() - Vec3(8, 0, 16)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((b.points.back() - Vec3(-8, 0, 15)).norm(), 0.0, 1e-9);
}

TEST(TreeBuilder, radii_stay_positive_where_a_lumen_narrows_at_once) {
  Axis axis;
  for (int i = 0; i <= 20; ++i) {
    axis.points.emplace_back(0, 0, 0.5 * i);
    axis.radius.push_back(i <= 10 ? 2.0 : 0.05);
  }
  ChainTree chains;
  chains.chains.resize(1);
  chains.chains.front().axis = axis;
  chains.ends = {{0, axis.points.size() - 1}};
  const geometry::VesselTree tree = split_tree(chains, 0.2, {}).tree;
  EXPECT_FALSE(geometry::find_fault(tree).has_value()) << *geometry::find_fault(tree);
  for (const double radius : tree.segments.front().axis.radius) EXPECT_GE(radius, 0.05);
}

TEST(TreeBuilder, steps_are_equal_and_frames_run_on) {
  const geometry::VesselTree tree = split_tree(merge_paths(y_paths(), {0, 1}, 0.15), 0.25, {}).tree;
  for (const geometry::TreeSegment& s : tree.segments) {
    for (std::size_t i = 1; i < s.axis.size(); ++i)
      EXPECT_LT(s.axis.abscissa[i] - s.axis.abscissa[i - 1], 0.2501);
    for (const geometry::TreeSegment& child : tree.segments) {
      if (child.from != s.to) continue;
      // All bends lie in the xz plane, so the binormal stays.
      EXPECT_GT(child.axis.frames.front().binormal.dot(s.axis.frames.back().binormal), 0.999);
    }
  }
}

TEST(TreeBuilder, a_target_on_another_path_ends_there) {
  const std::vector<Axis> paths = {path_through({{0, 0, 0}, {0, 0, 20}}),
                                   path_through({{0, 0, 0}, {0.02, 0, 12}})};
  const SplitTree split = split_tree(merge_paths(paths, {0, 1}, 0.15), 0.1, {});
  const geometry::VesselTree& tree = split.tree;
  EXPECT_FALSE(geometry::find_fault(tree).has_value()) << *geometry::find_fault(tree);
  EXPECT_EQ(tree.segments.size(), 2u);
  EXPECT_EQ(tree.vessels.size(), 1u);
  EXPECT_EQ(split.passed_targets, std::vector<std::size_t>{1});
  ASSERT_EQ(split.target_segments[1].size(), 1u);
  EXPECT_NEAR(geometry::segment(tree, split.target_segments[1][0]).axis.points.back().z(), 12.0, 0.1);
}

TEST(TreeBuilder, branches_that_part_at_the_source_share_the_root) {
  const std::vector<Axis> paths = {path_through({{0, 0, 0}, {0, 0, 9}}), path_through({{0, 0, 0}, {8, 0, 0}}),
                                   path_through({{0, 0, 0}, {0, -8, 0}})};
  const geometry::VesselTree tree = split_tree(merge_paths(paths, {0, 1, 2}, 0.15), 0.1, {}).tree;
  EXPECT_FALSE(geometry::find_fault(tree).has_value()) << *geometry::find_fault(tree);
  EXPECT_EQ(geometry::roots(tree).size(), 1u);
  EXPECT_EQ(geometry::ends(tree).size(), 3u);
  EXPECT_EQ(tree.segments.size(), 3u);
}

TEST(TreeBuilder, branch_of_a_branch) {
  const std::vector<Axis> paths = {path_through({{0, 0, 0}, {0, 0, 20}}),
                                   path_through({{0, 0, 0}, {0, 0, 5}, {10, 0, 10}}),
                                   path_through({{0, 0, 0}, {0, 0, 5}, {5, 0, 7.5}, {5, 8, 8}})};
  const geometry::VesselTree tree = split_tree(merge_paths(paths, {0, 1, 2}, 0.15), 0.1, {}).tree;
  EXPECT_FALSE(geometry::find_fault(tree).has_value()) << *geometry::find_fault(tree);
  EXPECT_EQ(tree.segments.size(), 5u);
  EXPECT_EQ(tree.vessels[2].segments.size(), 3u);
}

}  // namespace
}  // namespace ostia::centerline
