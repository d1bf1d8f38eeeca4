#include "calcified_tube.h"
#include "pipe_images.h"

#include "ostia/core/error.h"
#include "ostia/segmentation/minimal_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::segmentation {
namespace {

using testing::fork;
using testing::Fork;
using ::testing::HasSubstr;
using testing::pipe_image;

constexpr double kVoxelMm = 0.4;

/// A tube that bends in all directions, with noise.
struct BentTube {
  double radius;
  std::vector<Vec3> axis;
  imaging::ImageVolume image;
};
BentTube bent_tube(double radius) {
  BentTube tube{radius, {}, {}};
  for (double t = 0.0; t <= 1.4 * M_PI; t += 0.02)
    tube.axis.emplace_back(11.0 + 9.0 * std::cos(t), 26.0 + 9.0 * std::sin(t), 23.0 + 3.0 * t);
  tube.image =
      pipe_image({{tube.axis, radius, 380.0}}, {110, 110, 60}, Vec3::Constant(kVoxelMm), /*noise=*/25.0);
  return tube;
}

/// Every `each`-th point of the axis, moved across it to changing sides.
std::vector<Vec3> beside(const std::vector<Vec3>& axis, double off_mm, std::size_t each) {
  std::vector<Vec3> line;
  for (std::size_t i = 0; i < axis.size();
       i = i + 1 < axis.size() ? std::min(i + each, axis.size() - 1) : i + 1) {
    const Vec3 tangent = geometry::tangents(axis)[i];
    const Vec3 side = tangent.cross(Vec3::UnitZ()).normalized();
    const double angle = 2.1 * static_cast<double>(line.size());
    line.push_back(axis[i] + off_mm * (std::cos(angle) * side + std::sin(angle) * side.cross(tangent)));
  }
  return line;
}

void expect_axis_and_radius(const MinimalPath& path, const BentTube& tube, double from_mm, double to_mm) {
  const std::vector<double> s = geometry::abscissas(path.points);
  std::size_t looked_at = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] < from_mm || s[i] > to_mm) continue;
    ++looked_at;
    const double off = (geometry::closest(tube.axis, path.points[i]).point - path.points[i]).norm();
    EXPECT_LT(off, 0.25 * kVoxelMm) << "at " << s[i];
    EXPECT_NEAR(path.radius_mm[i], tube.radius, 0.25) << "at " << s[i];
  }
  EXPECT_GT(looked_at, 20U);
}

class AlongATube : public ::testing::TestWithParam<double> {};

TEST_P(AlongATube, ALineUpToARadiusOffBecomesItsAxis) {
  const BentTube tube = bent_tube(GetParam());
  const std::vector<Vec3> rough = beside(tube.axis, tube.radius, 20);  // every 4 mm
  const MinimalPath path = path_along(tube.image, rough);
  EXPECT_FALSE(path.junction.has_value());
  // Its ends are seen from one side alone.
  expect_axis_and_radius(path, tube, 1.0 + tube.radius, path.length_mm - 1.0 - tube.radius);
  EXPECT_LT(testing::mean_distance(path.points, tube.axis), 0.25 * kVoxelMm);
  EXPECT_NEAR(path.length_mm, geometry::length(tube.axis), 2.0);
  EXPECT_GT(path.evidence, 0.85);
  EXPECT_EQ(path.points.size(), path.radius_mm.size());
  EXPECT_EQ(path.points.size(), path.contrast.size());
}

TEST_P(AlongATube, ALineWithinItIsCentredWithoutASearch) {
  const BentTube tube = bent_tube(GetParam());
  PathAlongOptions options;
  options.corridor_mm = 0.0;
  const MinimalPath path = path_along(tube.image, beside(tube.axis, 0.5 * tube.radius, 2), options);
  EXPECT_EQ(path.visited, 0);
  expect_axis_and_radius(path, tube, 1.5, path.length_mm - 1.5);
}

INSTANTIATE_TEST_SUITE_P(Radii, AlongATube, ::testing::Values(0.9, 1.4, 2.0));

TEST(PathAlong, FewClicksThatCutTheCornersAreEnough) {
  const BentTube tube = bent_tube(1.2);
  const std::vector<Vec3> clicks = beside(tube.axis, 0.3, 55);  // every 10 mm; chords are 1.5 mm off
  ASSERT_LE(clicks.size(), 6U);
  const MinimalPath path = path_along(tube.image, clicks);
  expect_axis_and_radius(path, tube, 1.5, path.length_mm - 1.5);
}

TEST(PathAlong, WhatIsFixedStays) {
  const BentTube tube = bent_tube(1.2);
  // The first 5 mm lie outside of the tube.
  std::vector<Vec3> rough(tube.axis.begin() + 30, tube.axis.begin() + 160);
  const Vec3 away = (rough[0] - rough[1]).normalized() + 0.6 * Vec3::UnitZ();
  for (int n = 0; n < 10; ++n) rough.insert(rough.begin(), rough.front() + 0.5 * away.normalized());
  PathAlongOptions options;
  options.corridor_mm = 0.0;
  options.fixed_start_mm = 5.0;
  options.fixed_end_mm = 2.0;
  for (const double corridor : {0.0, 3.0}) {
    options.corridor_mm = corridor;
    const MinimalPath path = path_along(tube.image, rough, options);
    EXPECT_LT((path.points.front() - rough.front()).norm(), 1e-9);
    EXPECT_LT((path.points.back() - rough.back()).norm(), 1e-9);
    for (std::size_t i = 0; i < path.points.size() && i < 8; ++i)
      EXPECT_LT((geometry::closest(rough, path.points[i]).point - path.points[i]).norm(), 0.3) << i;
    expect_axis_and_radius(path, tube, 7.0, path.length_mm);
  }
}

TEST(PathAlong, CalciumBesideANarrowLumenNeitherAttractsNorRepels) {
  using Tube = ostia::testing::CalcifiedTube;
  PathAlongOptions options;
  options.corridor_mm = 0.0;
  const MinimalPath path = path_along(Tube::image(), Tube::line_through_nodule(), options);
  ASSERT_EQ(path.near_calcium.size(), path.points.size());
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Vec3& p = path.points[i];
    if (p.z() < 4.0 || p.z() > Tube::length_mm - 4.0) continue;
    const double off = (p - Tube::middle(p.z())).norm();
    EXPECT_LT(off, Tube::radius(p.z())) << "outside of the lumen at " << p.z();
    const double away = std::abs(p.z() - Tube::throat_mm);
    if (away > 6.0) {
      EXPECT_LT(off, 0.12) << p.z();
      EXPECT_EQ(path.near_calcium[i], 0) << p.z();
    }
    if (away < 1.0) {
      EXPECT_EQ(path.near_calcium[i], 1) << p.z();
    }
  }
}

TEST(PathAlong, ABranchIsJoinedToItsParent) {
  const Fork f = fork();
  std::vector<Vec3> rough;
  for (std::size_t i = 0; i < f.branch.size(); i += 2)
    rough.push_back(f.branch[i] + Vec3(0.2, i % 4 == 0 ? 0.2 : -0.2, 0.1));
  for (const double corridor : {0.0, 2.0}) {
    PathAlongOptions options;
    options.corridor_mm = corridor;
    const MinimalPath path = path_along_to_tree(f.image, rough, f.tree, options);
    ASSERT_TRUE(path.junction.has_value());
    EXPECT_EQ(path.junction->vessel, 3);
    EXPECT_NEAR(path.junction->s_mm, 12.0, 1.0);
    EXPECT_LT((path.points.front() - path.junction->point).norm(), 1e-9);
    EXPECT_LT(testing::mean_distance(path.points, f.branch), 0.15);
    EXPECT_LT(testing::mean_distance(f.branch, path.points), 0.2);
  }
  const std::vector<Vec3> far{f.branch[60], f.branch[80], f.branch.back()};
  EXPECT_THROW(path_along_to_tree(f.image, far, f.tree), GeometryError);
  const std::vector<Vec3> within{f.parent[10], f.parent[14], f.parent[18]};
  EXPECT_THROW(path_along_to_tree(f.image, within, f.tree), InvalidInput);
}

TEST(PathAlong, RefusesWhatCannotBeMeant) {
  const BentTube tube = bent_tube(1.2);
  const auto message = [&](const std::vector<Vec3>& rough, const PathAlongOptions& options = {}) {
    try {
      path_along(tube.image, rough, options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Vec3 a = tube.axis[20], b = tube.axis[80];
  EXPECT_THAT(message({a}), HasSubstr("two points or more"));
  EXPECT_THAT(message({a, a}), HasSubstr("free"));
  EXPECT_THAT(message({a, Vec3(500.0, 0.0, 0.0)}), HasSubstr("point 2 of the line"));
  EXPECT_THAT(message({a, Vec3(NAN, 0.0, 0.0)}), HasSubstr("outside the image"));
  PathAlongOptions wrong;
  wrong.corridor_mm = 11.0;
  EXPECT_THAT(message({a, b}, wrong), HasSubstr("corridor_mm"));
  wrong = {};
  wrong.fixed_start_mm = 900.0;
  EXPECT_THAT(message({a, b}, wrong), HasSubstr("are fixed"));
  wrong = {};
  wrong.path.step_mm = 0.0;
  EXPECT_THAT(message({a, b}, wrong), HasSubstr("step_mm"));
  EXPECT_THAT(message({a, Vec3(30.0, 8.0, 22.0)}), HasSubstr("no contrast-filled vessel"));
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(path_along(tube.image, {a, b}, {}, cancelled), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation
