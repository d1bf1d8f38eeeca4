#include "ostia/coronary/tree_growth.h"

#include "artery_scene.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ostia::coronary {
namespace {

using testing::Scene;

double nearest(const GrownTree& tree, const Vec3& to) {
  double best = std::numeric_limits<double>::infinity();
  for (const GrownBranch& branch : tree.branches)
    for (const Vec3& point : branch.points) best = std::min(best, (point - to).norm());
  return best;
}

TEST(TreeGrowth, FollowsArteriesAndNothingElse) {
  const Scene scene;
  const GrownTree tree = grow_tree(scene.image(), Scene::aorta(), scene.ostia());
  ASSERT_EQ(tree.branches.size(), 2U) << "the trunk with its end, and the side branch; the stub is too short";
  EXPECT_EQ(tree.branches[0].parent, -1);
  EXPECT_EQ(tree.branches[1].parent, 0);
  for (const GrownBranch& branch : tree.branches) {
    ASSERT_EQ(branch.points.size(), branch.radius_mm.size());
    ASSERT_EQ(branch.points.size(), branch.tube.size());
    for (const Vec3& point : branch.points) EXPECT_LT(scene.artery_distance(point), 0.3) << point.transpose();
  }
  for (std::size_t i = 0; i < 3; ++i)  // not the stub
    for (double t = 0.1; t < 0.95; t += 0.1)
      EXPECT_LT(nearest(tree, scene.arteries[i].from + t * (scene.arteries[i].to - scene.arteries[i].from)),
                0.8);
  const GrownBranch& side = tree.branches[1];
  EXPECT_EQ(side.points.front(), tree.branches[0].points[side.parent_point]);
  EXPECT_LT((side.points.front() - Vec3(0.0, 0.0, 20.0)).norm(), 2.5);
  EXPECT_LT((side.points.back() - Vec3(8.0, 16.0, 30.0)).norm(), 2.0);
}

TEST(TreeGrowth, KnowsHowWideItsVesselsAre) {
  const Scene scene;
  const GrownTree tree = grow_tree(scene.image(), Scene::aorta(), scene.ostia());
  ASSERT_EQ(tree.branches.size(), 2U);
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  EXPECT_NEAR(median(tree.branches[0].radius_mm), 1.5, 0.3);  // 1.6, then 1.2
  EXPECT_NEAR(median(tree.branches[1].radius_mm), 1.0, 0.25);
}

TEST(TreeGrowth, ByTheHessianTheArteriesAreFoundToo) {
  const Scene scene;
  GrowthOptions options;
  options.likeness = segmentation::TubeMethod::hessian;
  const imaging::ImageVolume image = scene.image();
  const GrownTree tree = grow_tree(image, Scene::aorta(), scene.ostia(), options);
  EXPECT_LT(nearest(tree, scene.arteries[1].to), 1.5);
  EXPECT_LT(nearest(tree, scene.arteries[2].to), 1.5);
  EXPECT_NE(tree.voxels, grow_tree(image, Scene::aorta(), scene.ostia()).voxels) << "another measure";
}

TEST(TreeGrowth, AShorterLimitTakesTheStubToo) {
  const Scene scene;
  GrowthOptions options;
  options.least_branch_mm = 4.0;
  EXPECT_EQ(grow_tree(scene.image(), Scene::aorta(), scene.ostia(), options).branches.size(), 3U);
}

TEST(TreeGrowth, AShortClearEndBehindABranchIsOne) {
  Scene scene;
  // Behind the branch 6 mm are left, 4 mm of them beyond its lumen.
  scene.arteries = {{{-20.0, 0.0, 20.0}, {0.0, 0.0, 20.0}, 1.1},
                    {{0.0, 0.0, 20.0}, {8.0, 14.0, 28.0}, 1.1},
                    {{0.0, 0.0, 20.0}, {5.2, 0.0, 20.0}, 0.8}};
  const GrownTree tree = grow_tree(scene.image(), Scene::aorta(), scene.ostia());
  ASSERT_EQ(tree.branches.size(), 2U);
  EXPECT_LT(nearest(tree, {5.2, 0.0, 20.0}), 0.8);
}

TEST(TreeGrowth, GoesOnBehindAClosedStretch) {
  const Scene scene = Scene::closed();
  const imaging::ImageVolume image = scene.image();
  const GrownTree tree = grow_tree(image, Scene::aorta(), scene.ostia());
  ASSERT_EQ(tree.branches.size(), 1U);
  const GrownBranch& branch = tree.branches[0];
  EXPECT_LT((branch.points.back() - scene.arteries[1].to).norm(), 1.8);
  for (const Vec3& point : branch.points)
    EXPECT_LT(std::min(scene.artery_distance(point), scene.plaques[0].distance(point)), 0.3);
  ASSERT_EQ(branch.gaps.size(), 1U);
  const auto [first, last] = branch.gaps[0];
  EXPECT_NEAR(branch.points[first].x(), -1.0, 1.0);
  EXPECT_NEAR(branch.points[last].x(), 7.0, 1.0);

  GrowthOptions options;
  options.longest_gap_mm = 0.0;
  const GrownTree short_one = grow_tree(image, Scene::aorta(), scene.ostia(), options);
  ASSERT_EQ(short_one.branches.size(), 1U);
  EXPECT_LT(short_one.branches[0].points.back().x(), 1.0);
  EXPECT_TRUE(short_one.branches[0].gaps.empty());
  options.longest_gap_mm = 4.0;  // less than is closed
  EXPECT_LT(grow_tree(image, Scene::aorta(), scene.ostia(), options).branches[0].points.back().x(), 1.0);
}

TEST(TreeGrowth, GoesNotOnIntoWhatIsAnother) {
  const auto farthest_x = [](const Scene& scene) {
    double most = -1e9;
    for (const GrownBranch& branch : grow_tree(scene.image(), Scene::aorta(), scene.ostia()).branches)
      for (const Vec3& point : branch.points) most = std::max(most, point.x());
    return most;
  };
  const Scene closed = Scene::closed();
  Scene vein = closed;
  vein.arteries.pop_back();
  vein.vein = closed.arteries[1];
  EXPECT_LT(farthest_x(vein), 1.0) << "in line, but fainter";
  Scene crossing = closed;
  crossing.arteries[1] = {{8.0, -14.0, 20.5}, {8.0, 14.0, 20.5}, 1.2};
  EXPECT_LT(farthest_x(crossing), 1.0) << "it passes by";
  Scene turned = closed;
  turned.arteries[1] = {{8.0, 0.0, 20.5}, {6.0, 14.0, 25.0}, 1.2};
  EXPECT_LT(farthest_x(turned), 1.0) << "it leads to the side";
  Scene wide = closed;
  wide.arteries[1].radius_mm = 2.6;
  EXPECT_LT(farthest_x(wide), 1.0) << "twice as wide";
  Scene chamber = closed;
  chamber.arteries.pop_back();
  chamber.chamber = {20.0, 0.0, 20.0};
  chamber.chamber_radius_mm = 13.0;
  EXPECT_LT(farthest_x(chamber), 1.0) << "no tube";
  Scene apart = closed;
  apart.plaques.clear();
  EXPECT_LT(farthest_x(apart), 1.0) << "fat between";
}

TEST(TreeGrowth, TheSameForAnyNumberOfThreads) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image(0.6);
  core::set_max_threads(1);
  const GrownTree alone = grow_tree(image, Scene::aorta(), scene.ostia());
  core::set_max_threads(3);
  const GrownTree together = grow_tree(image, Scene::aorta(), scene.ostia());
  core::set_max_threads(0);
  ASSERT_EQ(alone.branches.size(), together.branches.size());
  EXPECT_EQ(alone.voxels, together.voxels);
  for (std::size_t i = 0; i < alone.branches.size(); ++i) {
    EXPECT_EQ(alone.branches[i].points, together.branches[i].points);
    EXPECT_EQ(alone.branches[i].radius_mm, together.branches[i].radius_mm);
  }
}

TEST(TreeGrowth, RefusesWhatItCannotUseAndStopsWhenTold) {
  const Scene scene;
  const imaging::ImageVolume image = scene.image(1.2);
  EXPECT_THROW(grow_tree(image, Scene::aorta(), {}), InvalidInput);
  GrowthOptions options;
  options.least_tube = 0.9;
  EXPECT_THROW(grow_tree(image, Scene::aorta(), scene.ostia(), options), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(grow_tree(image, Scene::aorta(), scene.ostia(), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::coronary
