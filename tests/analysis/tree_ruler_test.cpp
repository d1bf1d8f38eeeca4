#include "ostia/analysis/tree_ruler.h"

#include "graph_trees.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

namespace ostia::analysis {
namespace {

using geometry::Vec3;
using geometry::VesselGraph;
using testing::graph_of;

using std::numbers::pi;

std::shared_ptr<const VesselGraph> shared(VesselGraph graph) {
  return std::make_shared<const VesselGraph>(std::move(graph));
}
void expect_close(double found, double truth) {
  EXPECT_NEAR(found, truth, 1e-6 * std::abs(truth) + 1e-12);
}

/// A trunk of 10 mm along x, a child of 6 mm along y, and one of 8 mm straight on; at the latter's end two of
/// 3 and 4 mm. Segment 1 is a cone.
VesselGraph two_forks() {
  VesselGraph graph =
      graph_of({{0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {18, 0, 0}, {18, 3, 0}, {18, 0, 4}},
               {{0, 1, 2, 2}, {1, 2, 1.5, 0.5}, {1, 3, 1.5, 1.5}, {3, 4, 1, 1}, {3, 5, 0.8, 0.8}});
  graph.references = {100, 101, 102, 103, 104};
  return graph;
}

TEST(TreeRuler, FactsOfACone) {
  const TreeRuler ruler(shared(two_forks()));
  const SegmentFacts facts = ruler.facts(1);
  EXPECT_EQ(facts.reference, 101);
  expect_close(facts.cone.length_mm, 6.0);
  expect_close(facts.cone.area_mm2, pi * 2.0 * std::sqrt(37.0));
  expect_close(facts.cone.volume_mm3, pi * 6.0 * (2.25 + 0.75 + 0.25) / 3.0);
  EXPECT_TRUE(facts.of_tree);
  EXPECT_EQ(facts.strahler, 1);
  expect_close(facts.from_root_mm, 10.0);
  EXPECT_EQ(facts.behind.segments, 1);
}

TEST(TreeRuler, WhatIsBehindASegment) {
  const TreeRuler ruler(shared(two_forks()));
  const SegmentFacts facts = ruler.facts(2);
  EXPECT_EQ(facts.strahler, 2);
  EXPECT_EQ(ruler.facts(0).strahler, 2);
  EXPECT_EQ(facts.behind.segments, 3);
  EXPECT_EQ(facts.behind.ends, 2);
  expect_close(facts.behind.length_mm, 15.0);
  expect_close(facts.behind.area_mm2, 2.0 * pi * (1.5 * 8 + 1.0 * 3 + 0.8 * 4));
  expect_close(facts.behind.volume_mm3, pi * (2.25 * 8 + 1.0 * 3 + 0.64 * 4));
  EXPECT_EQ(ruler.subtree(2), (std::vector<std::uint8_t>{0, 0, 1, 1, 1}));
  EXPECT_GE(ruler.facts(0).diameter_order, ruler.facts(3).diameter_order);
}

TEST(TreeRuler, DistancesAlongAndStraight) {
  const TreeRuler ruler(shared(two_forks()));
  const TreePlace on_child{1, 0.5}, on_leaf{4, 0.25}, on_trunk{0, 0.2}, other{0, 0.9};
  expect_close(*ruler.along_mm(on_child, on_leaf), 3.0 + 8.0 + 1.0);
  expect_close(ruler.straight_mm(on_child, on_leaf), std::sqrt(64.0 + 9.0 + 1.0));
  expect_close(*ruler.along_mm(on_trunk, on_leaf), 8.0 + 8.0 + 1.0);
  expect_close(*ruler.along_mm(on_leaf, on_trunk), 17.0);
  expect_close(*ruler.along_mm(on_trunk, other), 7.0);
  expect_close(ruler.radius_mm(on_child), 1.0);
}

TEST(TreeRuler, AlongIsNeverShorterThanStraightAndIsTheSameBothWays) {
  const TreeRuler ruler(shared(testing::binary_tree(9)));
  std::mt19937 random(7);
  const auto edges = static_cast<std::int32_t>(ruler.graph().edges.size());
  for (int i = 0; i < 300; ++i) {
    const auto place = [&] {
      return TreePlace{static_cast<std::int32_t>(random() % static_cast<unsigned>(edges)),
                       static_cast<double>(random() % 101) / 100.0};
    };
    const TreePlace a = place(), b = place(), c = place();
    const double ab = *ruler.along_mm(a, b);
    EXPECT_GE(ab, ruler.straight_mm(a, b) - 1e-12);
    EXPECT_NEAR(ab, *ruler.along_mm(b, a), 1e-12);
    EXPECT_LE(ab, *ruler.along_mm(a, c) + *ruler.along_mm(c, b) + 1e-12);
  }
}

TEST(TreeRuler, Angles) {
  const TreeRuler ruler(shared(two_forks()));
  expect_close(*ruler.angle_rad(0, 1), pi / 2.0);
  EXPECT_NEAR(*ruler.angle_rad(0, 2), 0.0, 1e-12);
  const ForkAngles* fork = ruler.fork_behind(0);
  ASSERT_TRUE(fork);
  EXPECT_EQ(fork->point, 1);
  expect_close(fork->between_rad, pi / 2.0);
  expect_close(ruler.fork_behind(2)->wide_rad, pi / 2.0);
  EXPECT_FALSE(ruler.fork_behind(4)) << "it ends there";
}

TEST(TreeRuler, TwoTreesHaveNoWayBetweenThem) {
  const TreeRuler ruler(
      shared(graph_of({{0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {1, 5, 0}}, {{0, 1, 1, 1}, {2, 3, 1, 1}})));
  EXPECT_TRUE(ruler.why_no_tree().empty());
  EXPECT_FALSE(ruler.along_mm({0, 0.5}, {1, 0.5}));
  expect_close(ruler.straight_mm({0, 0.5}, {1, 0.5}), 5.0);
}

TEST(TreeRuler, ALoopLeavesWhatNeedsNoTree) {
  const TreeRuler ruler(shared(graph_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
                                        {{0, 1, .1, .1}, {0, 2, .1, .1}, {1, 3, .1, .1}, {2, 3, .1, .1}})));
  EXPECT_FALSE(ruler.why_no_tree().empty());
  EXPECT_FALSE(ruler.report());
  const SegmentFacts facts = ruler.facts(3);
  EXPECT_FALSE(facts.of_tree);
  expect_close(facts.cone.length_mm, 1.0);
  EXPECT_FALSE(ruler.along_mm({0, 0.5}, {3, 0.5}));
  EXPECT_FALSE(ruler.fork_behind(0));
}

TEST(TreeRuler, ARegionCutsSegmentsAtItsSurface) {
  const TreeRuler ruler(shared(two_forks()));
  const SubtreeTotals all = ruler.within({9, 0, 0}, 100.0);
  EXPECT_EQ(all.segments, 5);
  EXPECT_EQ(all.ends, 3);
  expect_close(all.volume_mm3, ruler.facts(0).behind.volume_mm3);
  const SubtreeTotals part = ruler.within({10, 0, 0}, 3.0);
  EXPECT_EQ(part.segments, 3);
  EXPECT_EQ(part.ends, 0);
  expect_close(part.length_mm, 9.0);
  expect_close(part.volume_mm3, pi * (4.0 * 3 + 2.25 * 3 + 3.0 * (2.25 + 1.5 + 1.0) / 3.0));
  EXPECT_EQ(ruler.within({10, 50, 0}, 3.0).segments, 0);
  EXPECT_THROW(ruler.within({0, 0, 0}, -1.0), InvalidInput);
}

TEST(TreeRuler, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(TreeRuler(shared(testing::binary_tree(8)), task), Cancelled);
}

TEST(TreeRays, TakesWhatIsNearestToTheEye) {
  const auto graph = shared(two_forks());
  const TreeRays rays(graph);
  const auto hit = rays.first({{14.0, 0.0, 20.0}, -Vec3::UnitZ(), 0.0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->place.edge, 2);
  expect_close(hit->place.t, 0.5);
  expect_close(hit->depth_mm, 18.5);
  expect_close(hit->surface.z(), 1.5);
  const std::vector<std::uint8_t> shown{1, 1, 0, 1, 1};
  EXPECT_FALSE(rays.first({{14.0, 0.0, 20.0}, -Vec3::UnitZ(), 0.0}, shown));
  EXPECT_FALSE(rays.first({{14.0, 0.0, 20.0}, Vec3::UnitZ(), 0.0})) << "behind the eye";
  EXPECT_EQ(rays.first({{-5.0, 0.0, 0.0}, 3.0 * Vec3::UnitX(), 0.0})->place.edge, 0) << "end on";
}

TEST(TreeRays, EntersAConeWhereTheFirstOfItsBallsIs) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> spread(-4.0, 4.0), radii(0.1, 2.0);
  int hits = 0, on_walls = 0, grazed = 0;
  for (int i = 0; i < 400; ++i) {
    VesselGraph cone;
    cone.points = {{spread(random), spread(random), spread(random)},
                   {spread(random), spread(random), spread(random)}};
    cone.edges = {{0, 1, radii(random), radii(random)}};
    const Vec3 eye(spread(random), spread(random), 40.0);
    const Vec3 aim =
        0.5 * (cone.points[0] + cone.points[1]) + 0.4 * Vec3(spread(random), spread(random), spread(random));
    const TreeRay ray{eye, (aim - eye).normalized(), 0.0};
    const auto& e = cone.edges[0];
    double least = std::numeric_limits<double>::infinity();
    constexpr int balls = 20000;
    for (int k = 0; k <= balls; ++k) {
      const double t = static_cast<double>(k) / balls;
      const Vec3 away = ray.origin - ((1.0 - t) * cone.points[0] + t * cone.points[1]);
      const double r = (1.0 - t) * e.radius_from + t * e.radius_to, f = ray.direction.dot(away);
      const double h = f * f - away.squaredNorm() + r * r;
      if (h >= 0.0) least = std::min(least, -f - std::sqrt(h));
    }
    const auto hit = TreeRays(shared(cone)).first(ray);
    if (std::isinf(least)) {  // a graze between two of the balls that were tried is no fault
      if (hit) ++grazed;
      continue;
    }
    ASSERT_TRUE(hit) << i;
    EXPECT_LE(hit->depth_mm, least + 1e-9) << i;
    EXPECT_NEAR(hit->depth_mm, least, 1e-3) << i;
    ++hits;
    on_walls += hit->place.t > 0.0 && hit->place.t < 1.0 ? 1 : 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(on_walls, 60);
  EXPECT_LE(grazed, 1);
}

TEST(TreeRays, AnEyeInAVesselSeesItAtOnce) {
  VesselGraph tube;
  tube.points = {Vec3::Zero(), Vec3(10.0, 0.0, 0.0)};
  tube.edges = {{0, 1, 1.0, 1.0}};
  const TreeRays rays(shared(tube));
  EXPECT_EQ(rays.first({{5.0, 0.5, 0.0}, Vec3::UnitY(), 0.0})->depth_mm, 0.0);
  EXPECT_FALSE(rays.first({{5.0, 1.5, 0.0}, Vec3::UnitY(), 0.0}));
  EXPECT_FALSE(rays.first({{11.5, 0.0, 0.0}, Vec3::UnitX(), 0.0}));
}

TEST(TreeRays, SlackReachesThinVessels) {
  VesselGraph thin = testing::line_of(3);
  for (auto& e : thin.edges) e.radius_from = e.radius_to = 0.0;
  const TreeRays rays(shared(thin));
  const TreeRay past{{0.5, -100.0, 1.5}, Vec3::UnitY(), 0.004};
  EXPECT_FALSE(rays.first(past));
  EXPECT_EQ(rays.first({past.origin, past.direction, 0.006})->place.edge, 1);
}

TEST(TreeRays, FindsWhatTryingAllFinds) {
  const auto graph = shared(testing::binary_tree(8, 0.8, 0.7));
  const TreeRays rays(graph);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-2.0, 4.0);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const TreeRay ray{{spread(random), spread(random), 30.0},
                      Vec3(0.02 * spread(random), 0.02 * spread(random), -1.0),
                      0.0005};
    std::optional<TreeRayHit> best;
    for (std::size_t e = 0; e < graph->edges.size(); ++e) {
      std::vector<std::uint8_t> alone(graph->edges.size(), 0);
      alone[e] = 1;
      const auto one = rays.first(ray, alone);
      if (one && (!best || one->depth_mm < best->depth_mm)) best = one;
    }
    const auto found = rays.first(ray);
    ASSERT_EQ(found.has_value(), best.has_value());
    if (!found) continue;
    ++hits;
    EXPECT_EQ(found->place.edge, best->place.edge);
  }
  EXPECT_GT(hits, 50);
}

TEST(TreeGrid, StepsAreOneTwoFive) {
  EXPECT_DOUBLE_EQ(grid_scale(100.0, 5).step_mm, 20.0);
  EXPECT_DOUBLE_EQ(grid_scale(8.0, 5).step_mm, 2.0);
  EXPECT_DOUBLE_EQ(grid_scale(7.9, 5).step_mm, 1.0);
  EXPECT_DOUBLE_EQ(grid_scale(0.02, 5).step_mm, 0.005);
  EXPECT_EQ(grid_scale(100.0, 5).unit, "cm");
  EXPECT_EQ(grid_scale(8.0, 5).unit, "mm");
  EXPECT_EQ(grid_scale(0.02, 5).unit, "um");
  EXPECT_THROW(grid_scale(0.0), InvalidInput);
  EXPECT_THROW(grid_scale(1.0, 1), InvalidInput);
}

TEST(TreeGrid, TicksAndTheirTexts) {
  EXPECT_THAT(grid_ticks(-0.3, 0.4, 0.2),
              ::testing::ElementsAre(::testing::DoubleEq(-0.2), 0.0, ::testing::DoubleEq(0.2),
                                     ::testing::DoubleEq(0.4)));
  EXPECT_TRUE(grid_ticks(0.1, 0.15, 1.0).empty());
  EXPECT_THROW(grid_ticks(0.0, 1e9, 1.0), InvalidInput);
  EXPECT_EQ(tick_text(0.4, grid_scale(0.8, 5)), "0.4 mm");
  EXPECT_EQ(tick_text(40.0, grid_scale(100.0, 5)), "4 cm");
  EXPECT_EQ(tick_text(0.015, grid_scale(0.02, 5)), "15 um");
}

}  // namespace
}  // namespace ostia::analysis
