#include "ostia/segmentation/minimal_path.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace ostia::segmentation {
namespace {

using ::testing::HasSubstr;

/// A tube about a line: its contrast is added to the background where the lumen is.
struct Pipe {
  std::vector<Vec3> axis;
  double radius = 1.0;
  double hu = 350.0;
};

/// Tubes with walls blurred by a Gaussian (sigma 0.35 mm), with noise.
imaging::ImageVolume pipe_image(const std::vector<Pipe>& pipes, const std::array<std::int64_t, 3>& size,
                                const Vec3& spacing, double noise = 15.0) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = Vec3(-10.0, 5.0, 20.0);
  std::vector<float> values(static_cast<std::size_t>(image.geometry.voxels()), 60.0F);
  for (const Pipe& pipe : pipes) {
    const std::vector<Vec3> dense = geometry::resample(pipe.axis, 0.3);
    std::vector<float> nearest(values.size(), 1e9F);
    const double reach = pipe.radius + 1.6;
    for (const Vec3& p : dense) {
      const Vec3 at = image.geometry.index(p);
      const Vec3 half = Vec3::Constant(reach).cwiseQuotient(spacing);
      std::array<std::int64_t, 3> low{}, high{};
      for (int d = 0; d < 3; ++d) {
        low[static_cast<std::size_t>(d)] = std::max<std::int64_t>(0, std::llround(at[d] - half[d]));
        high[static_cast<std::size_t>(d)] =
            std::min<std::int64_t>(size[static_cast<std::size_t>(d)] - 1, std::llround(at[d] + half[d]));
      }
      for (std::int64_t k = low[2]; k <= high[2]; ++k)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
          for (std::int64_t i = low[0]; i <= high[0]; ++i) {
            const Vec3 w = image.geometry.world(
                Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
            float& n = nearest[static_cast<std::size_t>(image.geometry.offset(i, j, k))];
            n = std::min(n, static_cast<float>((w - p).norm()));
          }
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (nearest[v] > reach) continue;
      const double part = 0.5 * std::erfc((nearest[v] - pipe.radius) / (std::sqrt(2.0) * 0.35));
      values[v] = std::max(values[v], static_cast<float>(60.0 + (pipe.hu - 60.0) * part));
    }
  }
  std::mt19937 generator(11);
  std::normal_distribution<float> random(0.0F, static_cast<float>(noise));
  image.voxels.resize(values.size());
  for (std::size_t v = 0; v < values.size(); ++v)
    image.voxels[v] = static_cast<std::int16_t>(std::lround(values[v] + random(generator)));
  return image;
}

std::vector<Vec3> line(const Vec3& from, const Vec3& to) {
  return geometry::resample({from, to}, 0.5);
}

geometry::VesselTree tree_of(const std::vector<Vec3>& axis, double radius, std::int32_t id = 3) {
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.front()}, {2, axis.back()}};
  geometry::TreeSegment segment;
  segment.id = 5;
  segment.from = 1;
  segment.to = 2;
  segment.axis.points = axis;
  segment.axis.radius.assign(axis.size(), radius);
  geometry::complete(segment.axis);
  tree.segments = {segment};
  tree.vessels = {{id, "LAD", {5}}};
  return tree;
}

double mean_distance(const std::vector<Vec3>& points, const std::vector<Vec3>& truth, double skip_mm = 0.0) {
  const std::vector<double> s = geometry::abscissas(points);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (s[i] < skip_mm) continue;
    sum += (geometry::closest(truth, points[i]).point - points[i]).norm();
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// A straight parent along x and a curved branch that leaves it at 60 degrees.
struct Fork {
  std::vector<Vec3> parent, branch;
  Vec3 junction;
  geometry::VesselTree tree;
  imaging::ImageVolume image;
};

Fork fork(const std::vector<Pipe>& others = {}, double gap_from = 0.0, double gap_to = 0.0) {
  Fork f;
  f.parent = line(Vec3(-12.0, 15.0, 30.0), Vec3(32.0, 15.0, 30.0));
  f.junction = Vec3(0.0, 15.0, 30.0);
  for (double t = 0.0; t <= 1.0001; t += 0.01) {
    const double angle = (60.0 - 80.0 * t) * M_PI / 180.0;  // bends forward
    const Vec3 step(std::cos(angle), std::sin(angle), 0.35 * std::sin(5.0 * t));
    f.branch.push_back(f.branch.empty() ? f.junction : Vec3(f.branch.back() + 0.3 * step));
  }
  std::vector<Pipe> pipes{{f.parent, 1.8, 380.0}};
  if (gap_to > gap_from) {
    const std::vector<double> s = geometry::abscissas(f.branch);
    Pipe proximal{{}, 1.1, 360.0}, distal{{}, 1.1, 360.0};
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s[i] <= gap_from) proximal.axis.push_back(f.branch[i]);
      if (s[i] >= gap_to) distal.axis.push_back(f.branch[i]);
    }
    pipes.push_back(proximal);
    pipes.push_back(distal);
  } else {
    pipes.push_back({f.branch, 1.1, 360.0});
  }
  pipes.insert(pipes.end(), others.begin(), others.end());
  f.tree = tree_of(f.parent, 1.8);
  f.image = pipe_image(pipes, {120, 100, 50}, Vec3(0.4, 0.4, 0.5));
  return f;
}

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
