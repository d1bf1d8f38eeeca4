#include "ostia/segmentation/minimal_path.h"

#include "pipe_images.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::segmentation {
namespace {

using testing::fork;
using testing::Fork;
using ::testing::HasSubstr;
using testing::line;
using testing::mean_distance;
using testing::Pipe;
using testing::pipe_image;

TEST(MinimalPath, BranchIsFollowedBackToItsParent) {
  const Fork f = fork();
  const MinimalPath path = path_to_tree(f.image, f.branch.back(), f.tree);
  ASSERT_TRUE(path.junction.has_value());
  EXPECT_EQ(path.junction->vessel, 3);
  EXPECT_NEAR(path.junction->s_mm, 12.0, 1.0);
  EXPECT_LT((path.junction->point - f.junction).norm(), 1.0);
  EXPECT_LT((path.points.front() - path.junction->point).norm(), 1e-9);
  EXPECT_LT((path.points.back() - f.branch.back()).norm(), 0.8);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.15);
  EXPECT_LT(mean_distance(f.branch, path.points), 0.2);
  EXPECT_NEAR(path.length_mm, geometry::length(f.branch), 1.0);
  ASSERT_EQ(path.radius_mm.size(), path.points.size());
  ASSERT_EQ(path.contrast.size(), path.points.size());
  const std::vector<double> s = geometry::abscissas(path.points);
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (i > 0) {
      EXPECT_NEAR((path.points[i] - path.points[i - 1]).norm(), 0.5, 0.05);
    }
    if (s[i] > 4.0 && s[i] < path.length_mm - 2.0) {
      EXPECT_NEAR(path.radius_mm[i], 1.1, 0.25) << s[i];
    }
  }
  EXPECT_GT(path.evidence, 0.85);
  EXPECT_TRUE(path.warnings.empty()) << path.warnings.front();
  EXPECT_LT(path.visited, f.image.geometry.voxels() / 10);
}

TEST(MinimalPath, ClickBesideTheLumenIsMovedOntoIt) {
  const Fork f = fork();
  const Vec3 end = f.branch[90];
  const Vec3 across = (f.branch[91] - f.branch[89]).cross(Vec3::UnitZ()).normalized();
  const MinimalPath path = path_to_tree(f.image, end + 1.7 * across, f.tree);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.2);
  ASSERT_FALSE(path.warnings.empty());
  EXPECT_THAT(path.warnings.front(), HasSubstr("the click was moved by"));
}

TEST(MinimalPath, StretchWithoutContrastIsCrossedAndTold) {
  const Fork f = fork({}, 12.0, 17.0);
  const MinimalPath path = path_to_tree(f.image, f.branch.back(), f.tree);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.35);
  EXPECT_NEAR(path.junction->s_mm, 12.0, 1.5);
  ASSERT_EQ(path.warnings.size(), 1U);
  EXPECT_THAT(path.warnings[0], HasSubstr("the way leaves the contrast for"));
  double gap = 0.0;
  ASSERT_EQ(std::sscanf(path.warnings[0].c_str(), "the way leaves the contrast for %lf mm", &gap), 1);
  EXPECT_NEAR(gap, 17.0 - 12.0 - 2.0 * 1.1, 1.0);  // its ends are round
  EXPECT_LT(path.evidence, path_to_tree(fork().image, f.branch.back(), f.tree).evidence);
}

TEST(MinimalPath, ParallelVeinIsNotTaken) {
  std::vector<Vec3> vein;
  for (const Vec3& p : fork().branch) vein.push_back(p + Vec3(0.0, 0.0, 3.0));
  vein.insert(vein.begin(), vein.front() + Vec3(-8.0, -6.0, 2.0));
  const Fork f = fork({{vein, 1.4, 240.0}});
  const MinimalPath path = path_to_tree(f.image, f.branch.back(), f.tree);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.3);
  EXPECT_GT(mean_distance(path.points, vein, 4.0), 2.0);
  EXPECT_EQ(path.junction->vessel, 3);
}

TEST(MinimalPath, CalciumDoesNotAttract) {
  const Fork plain = fork();
  std::vector<Pipe> plaques;
  for (const std::size_t i : {35U, 60U}) {
    const Vec3 side = (plain.branch[i + 1] - plain.branch[i - 1]).cross(Vec3::UnitZ()).normalized();
    plaques.push_back({line(plain.branch[i] + 1.9 * side, plain.branch[i + 8] + 1.9 * side), 0.7, 1200.0});
  }
  const Fork f = fork(plaques);
  const MinimalPath path = path_to_tree(f.image, f.branch.back(), f.tree);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.3);
  for (std::size_t i = 6; i < path.points.size(); ++i) {  // from clear of the parent on
    const Vec3& p = path.points[i];
    EXPECT_LT((geometry::closest(f.branch, p).point - p).norm(), 0.8) << "point " << i;
  }
}

TEST(MinimalPath, ABranchBrighterThanItsTreeIsNotTakenForCalcium) {
  Fork f = fork({Pipe{fork().branch, 1.1, 480.0}});
  const MinimalPath path = path_to_tree(f.image, f.branch.back(), f.tree);
  EXPECT_LT(mean_distance(path.points, f.branch), 0.15);
  EXPECT_LT(std::count(path.near_calcium.begin(), path.near_calcium.end(), 1),
            static_cast<std::ptrdiff_t>(path.points.size() / 10));
}

TEST(MinimalPath, WayBetweenTwoEndsOfAHelix) {
  std::vector<Vec3> helix;
  for (double t = 0.0; t <= 1.5 * M_PI; t += 0.02)
    helix.emplace_back(10.0 + 9.0 * std::cos(t), 25.0 + 9.0 * std::sin(t), 24.0 + 2.5 * t);
  const auto image = pipe_image({{helix, 0.9, 300.0}}, {110, 110, 40}, Vec3(0.4, 0.4, 0.5));
  const MinimalPath path = path_between(image, helix.front(), helix.back());
  EXPECT_FALSE(path.junction.has_value());
  EXPECT_LT(mean_distance(path.points, helix), 0.15);
  EXPECT_LT((path.points.front() - helix.front()).norm(), 0.8);
  EXPECT_LT((path.points.back() - helix.back()).norm(), 0.8);
  EXPECT_NEAR(path.length_mm, geometry::length(helix), 0.03 * geometry::length(helix));
  EXPECT_THROW(path_between(image, helix.front(), helix.front()), InvalidInput);
}

TEST(MinimalPath, RefusesWhatCannotBeMeant) {
  const Fork f = fork();
  const auto message = [&](const Vec3& click, const MinimalPathOptions& options = {}) -> std::string {
    try {
      path_to_tree(f.image, click, f.tree, options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message(Vec3(500.0, 0.0, 0.0)), HasSubstr("outside the image"));
  EXPECT_THAT(message(Vec3(NAN, 0.0, 0.0)), HasSubstr("outside the image"));
  EXPECT_THAT(message(f.junction), HasSubstr("inside vessel 'LAD'"));
  EXPECT_THAT(message(Vec3(30.0, 40.0, 40.0)), HasSubstr("no contrast-filled vessel within"));
  MinimalPathOptions wrong;
  wrong.step_mm = 0.0;
  EXPECT_THAT(message(f.branch.back(), wrong), HasSubstr("step_mm"));
  EXPECT_THROW(path_to_tree(f.image, f.branch.back(), geometry::VesselTree{}), InvalidInput);

  imaging::ImageVolume air = f.image;
  for (auto& hu : air.voxels)
    if (hu < 200) hu = -1000;
  try {
    path_to_tree(air, Vec3(30.0, 40.0, 40.0), f.tree);
    FAIL() << "a click in air was taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("lies in air (-1000 HU)"));
  }
}

TEST(MinimalPath, GivesUpWithinItsBudget) {
  const Fork f = fork();
  MinimalPathOptions options;
  options.max_length_mm = 20.0;  // the branch has 30
  try {
    path_to_tree(f.image, f.branch.back(), f.tree, options);
    FAIL() << "a way beyond the limit was found";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("max_length_mm"));
  }
  options.max_length_mm = 150.0;
  options.most_voxels = 1000;
  EXPECT_THROW(path_to_tree(f.image, f.branch.back(), f.tree, options), GeometryError);
}

TEST(MinimalPath, SameBitsAgainAndCancelled) {
  const Fork f = fork();
  core::TaskContext task;
  const MinimalPath a = path_to_tree(f.image, f.branch.back(), f.tree, {}, task);
  EXPECT_EQ(task.progress(), 1.0);
  core::set_max_threads(1);
  const MinimalPath b = path_to_tree(f.image, f.branch.back(), f.tree);
  core::set_max_threads(0);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]);
  EXPECT_EQ(a.radius_mm, b.radius_mm);
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(path_to_tree(f.image, f.branch.back(), f.tree, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
