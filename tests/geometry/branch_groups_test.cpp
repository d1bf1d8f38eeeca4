#include "ostia/geometry/branch_groups.h"

#include "ostia/core/error.h"
#include "ostia/geometry/ball_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

constexpr double radius_mm = 2.0;

/// Points every 0.25 mm, both ends kept.
Centerline branch_between(const Vec3& from, const Vec3& to, double radius = radius_mm) {
  Centerline line;
  const auto pieces = static_cast<int>(std::ceil((to - from).norm() / 0.25));
  for (int i = 0; i <= pieces; ++i) {
    line.points.push_back(from + (to - from) * i / pieces);
    line.radius.push_back(radius);
  }
  complete(line);
  return line;
}

/// A parent along +z to the origin, two straight children in the xz plane, `between` apart.
VesselTree straight_fork(double between_rad) {
  const double half = 0.5 * between_rad;
  const std::vector<Vec3> p{{0, 0, -20},
                            {0, 0, 0},
                            {20 * std::sin(half), 0, 20 * std::cos(half)},
                            {-20 * std::sin(half), 0, 20 * std::cos(half)}};
  VesselTree tree;
  for (std::size_t i = 0; i < p.size(); ++i) tree.nodes.push_back({static_cast<std::int32_t>(i), p[i]});
  tree.segments = {{10, 0, 1, branch_between(p[0], p[1])},
                   {11, 1, 2, branch_between(p[1], p[2])},
                   {12, 1, 3, branch_between(p[1], p[3])}};
  tree.vessels = {{5, "a", {10, 11}}, {6, "b", {10, 12}}};
  return tree;
}

/// A trunk along +z with side branches at the given heights, along +x and -x by turns; it ends at 40 mm.
VesselTree comb(const std::vector<double>& heights_mm) {
  VesselTree tree;
  Vec3 at(0, 0, 0);
  tree.nodes.push_back({0, at});
  std::vector<std::int32_t> trunk;
  const auto add = [&](std::int32_t from, const Vec3& start, const Vec3& end) {
    const auto node = static_cast<std::int32_t>(tree.nodes.size());
    const auto id = static_cast<std::int32_t>(tree.segments.size());
    tree.nodes.push_back({node, end});
    tree.segments.push_back({id, from, node, branch_between(start, end)});
    return std::pair(id, node);
  };
  std::int32_t node = 0;
  for (const double height : heights_mm) {
    const auto [up, joint] = add(node, at, {0, 0, height});
    trunk.push_back(up);
    at = {0, 0, height};
    const double way = tree.vessels.size() % 2 == 0 ? 15.0 : -15.0;
    const auto [side, tip] = add(joint, at, at + Vec3(way, 0, 0));
    auto path = trunk;
    path.push_back(side);
    tree.vessels.push_back({tip, "side", path});
    node = joint;
  }
  const auto [last, tip] = add(node, at, {0, 0, 40});
  trunk.push_back(last);
  tree.vessels.insert(tree.vessels.begin(), {tip, "trunk", trunk});
  return tree;
}

std::vector<int> group_ids(const BranchedLine& line) {
  std::vector<int> ids;
  for (const Tract& tract : line.tracts) ids.push_back(tract.blanked ? -tract.group : tract.group);
  return ids;
}

double start_mm(const BranchedLine& line, std::size_t tract) {
  return value_at(line.axis.abscissa, line.tracts[tract].places.front());
}
double end_mm(const BranchedLine& line, std::size_t tract) {
  return value_at(line.axis.abscissa, line.tracts[tract].places.back());
}

TEST(BranchGroups, AForkIsCutWhereTheChildLeavesTheOthersSpheresAndOneSphereBefore) {
  for (const double between_deg : {40.0, 60.0, 90.0, 120.0}) {
    const double between = between_deg * std::numbers::pi / 180.0;
    const BranchedLines all = branch_groups(straight_fork(between));
    ASSERT_EQ(all.lines.size(), 2u);
    EXPECT_EQ(all.groups, 4);
    EXPECT_EQ(group_ids(all.lines[0]), (std::vector<int>{0, -1, 2}));
    EXPECT_EQ(group_ids(all.lines[1]), (std::vector<int>{0, -1, 3}));
    // The child is r from the other's axis at r / sin of the angle between; beyond 90 degrees the ball at the
    // fork is the last one left.
    const double leaves = 20.0 + radius_mm / (between_deg < 90.0 ? std::sin(between) : 1.0);
    for (const BranchedLine& line : all.lines) {
      EXPECT_NEAR(end_mm(line, 1), leaves, 1e-9) << between_deg;
      EXPECT_NEAR(start_mm(line, 1), leaves - radius_mm, 1e-9) << between_deg;
      EXPECT_EQ(start_mm(line, 0), 0.0);
      EXPECT_NEAR(end_mm(line, 2), 40.0, 1e-9);
    }
    EXPECT_EQ(all.lines[0].vessel, 5);
  }
}

TEST(BranchGroups, ForksFarApartAreTwoBifurcationsAndForksThatOverlapAreOne) {
  const BranchedLines apart = branch_groups(comb({10, 25}));
  ASSERT_EQ(apart.lines.size(), 3u);
  EXPECT_EQ(group_ids(apart.lines[0]), (std::vector<int>{0, -1, 2, -3, 4}));
  EXPECT_EQ(group_ids(apart.lines[1]), (std::vector<int>{0, -1, 5}));
  EXPECT_EQ(group_ids(apart.lines[2]), (std::vector<int>{0, -1, 2, -3, 6}));
  const BranchedLines together = branch_groups(comb({10, 11}));
  EXPECT_EQ(group_ids(together.lines[0]), (std::vector<int>{0, -1, 2}));
  EXPECT_EQ(group_ids(together.lines[1]), (std::vector<int>{0, -1, 3}));
  EXPECT_EQ(group_ids(together.lines[2]), (std::vector<int>{0, -1, 4}));
}

TEST(BranchGroups, TractsFollowOneAnotherAndHoldEveryPointOfTheVessel) {
  const BranchedLines all = branch_groups(comb({8, 12, 30}));
  for (const BranchedLine& line : all.lines) {
    std::size_t own = 0;
    for (std::size_t t = 0; t < line.tracts.size(); ++t) {
      if (t > 0) {
        EXPECT_EQ(line.tracts[t].places.front(), line.tracts[t - 1].places.back());
      }
      for (std::size_t i = t > 0 ? 1 : 0; i < line.tracts[t].places.size(); ++i)
        own += line.tracts[t].places[i].t == 0.0;
    }
    EXPECT_EQ(own, line.axis.size());
    EXPECT_EQ(line.segments.size(), line.axis.size());
    EXPECT_EQ(end_mm(line, line.tracts.size() - 1), line.axis.abscissa.back());
  }
}

TEST(BranchGroups, LinesThatRunSideBySideFromTheRootAreOneBranchUntilTheyPart) {
  // As VMTK's centerlines: each from the source to its own target, nowhere the same.
  const VesselTree joined = straight_fork(std::numbers::pi / 3.0);
  VesselTree apart = joined;
  apart.segments.clear();
  for (std::int32_t v = 0; v < 2; ++v) {
    Centerline line = vessel_axis(joined, joined.vessels[static_cast<std::size_t>(v)]);
    for (std::size_t i = 1; i < line.size(); ++i) line.points[i].y() += v == 0 ? 0.05 : -0.05;
    complete(line);
    apart.nodes[static_cast<std::size_t>(2 + v)].position = line.points.back();
    apart.segments.push_back({v, 0, 2 + v, line});
    apart.vessels[static_cast<std::size_t>(v)].segments = {v};
  }
  const BranchedLines all = branch_groups(apart);
  EXPECT_EQ(group_ids(all.lines[0]), (std::vector<int>{0, -1, 2}));
  EXPECT_EQ(group_ids(all.lines[1]), (std::vector<int>{0, -1, 3}));
  EXPECT_NEAR(end_mm(all.lines[0], 1), 20.0 + radius_mm / std::sin(std::numbers::pi / 3.0), 0.02);
}

TEST(BranchGroups, AVesselAloneIsOneBranch) {
  VesselTree tree = straight_fork(1.0);
  tree.vessels.pop_back();
  const BranchedLines all = branch_groups(tree);
  ASSERT_EQ(all.lines.size(), 1u);
  EXPECT_EQ(group_ids(all.lines[0]), (std::vector<int>{0}));
}

TEST(BranchGroups, AVesselThatEndsWithinTheOthersTubeHasNoBranchOfItsOwn) {
  VesselTree tree = straight_fork(1.0);
  tree.nodes[3].position = Vec3(-0.5, 0, 1);
  tree.segments[2].axis = branch_between(tree.nodes[1].position, tree.nodes[3].position);
  const BranchedLines all = branch_groups(tree);
  EXPECT_EQ(all.lines[1].tracts.back().blanked, true);
  EXPECT_EQ(all.lines[0].tracts.back().blanked, false);
}

TEST(BranchGroups, AVesselWithoutSegmentsIsRefused) {
  VesselTree tree = straight_fork(1.0);
  tree.vessels.push_back({9, "none", {}});
  EXPECT_THROW(branch_groups(tree), InvalidInput);
  tree.vessels.back().segments = {77};
  EXPECT_THROW(branch_groups(tree), InvalidInput);
}

TEST(BallLine, IsTheLeastOfAllBalls) {
  Centerline line;
  for (int i = 0; i <= 60; ++i) {
    line.points.emplace_back(8.0 * std::cos(0.1 * i), 8.0 * std::sin(0.1 * i), 0.3 * i);
    line.radius.push_back(1.5 + std::sin(0.4 * i));
  }
  complete(line);
  const BallLine tube(line);
  for (int k = 0; k < 60; ++k) {
    const Vec3 x(12.0 * std::sin(1.7 * k), 11.0 * std::cos(2.3 * k), 20.0 * std::sin(0.9 * k));
    double least = INFINITY;
    for (std::size_t p = 0; p + 1 < line.size(); ++p)
      for (int i = 0; i <= 400; ++i) {
        const LinePlace place{p, i / 400.0};
        const double t = place.t;
        const Vec3 c = (1.0 - t) * line.points[p] + t * line.points[p + 1];
        const double r = (1.0 - t) * line.radius[p] + t * line.radius[p + 1];
        least = std::min(least, (x - c).squaredNorm() - r * r);
      }
    const BallLine::Nearest near = tube.nearest(x);
    EXPECT_LE(near.value, least + 1e-9);
    EXPECT_NEAR(near.value, least, 1e-3);
    const double r = value_at(line.radius, near.place);
    EXPECT_NEAR((value_at(line.points, near.place) - x).squaredNorm() - r * r, near.value, 1e-9);
  }
  EXPECT_THROW(BallLine(Centerline{{Vec3::Zero()}, {1.0}, {}, {}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
