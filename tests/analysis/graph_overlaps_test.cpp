#include "ostia/analysis/graph_overlaps.h"

#include "graph_trees.h"
#include "growth/round_cones.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

namespace {

using namespace ostia;
using namespace ostia::analysis;
using namespace ostia::analysis::testing;

std::vector<GraphOverlap> overlaps_of(const VesselGraph& graph, const OverlapOptions& options = {}) {
  return find_overlaps(graph, geometry::GraphIncidence(graph), options);
}

TEST(RoundCones, MeetByTheSumOfTheirRadii) {
  const RoundCone a{{0, 0, 0}, {10, 0, 0}, 1.0, 1.0};
  const auto crossing = contact(a, {{5, -5, 1.5}, {5, 5, 1.5}, 1.0, 1.0});
  ASSERT_TRUE(crossing.has_value());
  EXPECT_NEAR(crossing->depth, 0.5, 1e-9);
  EXPECT_NEAR(crossing->s, 0.5, 1e-6);
  EXPECT_NEAR((crossing->place - Vec3(5, 0, 0.75)).norm(), 0.0, 1e-6);
  EXPECT_FALSE(contact(a, {{5, -5, 2.0001}, {5, 5, 2.0001}, 1.0, 1.0}).has_value());
  EXPECT_TRUE(contact(a, {{5, -5, 1.9999}, {5, 5, 1.9999}, 1.0, 1.0}).has_value());
}

TEST(RoundCones, TaperIsKnownAlongTheAxis) {
  // A cone of slope 0.1 beside a parallel thread: radius 1 at the left, 2 at the right.
  const RoundCone cone{{0, 0, 0}, {10, 0, 0}, 1.0, 2.0};
  EXPECT_FALSE(contact(cone, {{0, 1.3, 0}, {2, 1.3, 0}, 0.05, 0.05}).has_value());
  EXPECT_TRUE(contact(cone, {{0, 1.3, 0}, {3, 1.3, 0}, 0.05, 0.05}).has_value());
}

TEST(RoundCones, AgreeWithManyBallsTriedOut) {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  int met = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto cone = [&] {
      const auto point = [&] { return Vec3(number(-1, 1), number(-1, 1), number(-1, 1)); };
      return RoundCone{point(), point(), number(0.0, 0.4), number(0.0, 0.4)};
    };
    const RoundCone a = cone(), b = cone();
    double deepest = -1e9;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) {
        const double s = i / 200.0, t = j / 200.0;
        const Vec3 p = a.from + s * (a.to - a.from), q = b.from + t * (b.to - b.from);
        const double r = a.radius_from + s * (a.radius_to - a.radius_from) + b.radius_from +
                         t * (b.radius_to - b.radius_from);
        deepest = std::max(deepest, r - (p - q).norm());
      }
    const auto hit = contact(a, b);
    EXPECT_EQ(hit.has_value(), deepest > 1e-9 || (hit && hit->depth < 2e-2)) << trial;
    if (hit) {
      EXPECT_NEAR(hit->depth, deepest, 2e-2) << trial;
      EXPECT_GE(hit->depth, deepest - 1e-9) << trial;
    }
    met += hit ? 1 : 0;
  }
  EXPECT_GT(met, 20);
  EXPECT_LT(met, 180);
}

TEST(GraphOverlaps, FindsTwoVesselsThatCross) {
  const VesselGraph graph = graph_of({{-5, 0, 0}, {5, 0, 0}, {0, -5, 1}, {0, 5, 1}, {0, -5, 3}, {0, 5, 3}},
                                     {{0, 1, 0.6, 0.6}, {2, 3, 0.6, 0.6}, {4, 5, 0.6, 0.6}});
  const std::vector<GraphOverlap> found = overlaps_of(graph);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first, 0);
  EXPECT_EQ(found[0].second, 1);
  EXPECT_NEAR(found[0].depth_mm, 0.2, 1e-9);
  EXPECT_NEAR((found[0].place - Vec3(0, 0, 0.5)).norm(), 0.0, 1e-6);
}

/// Two windings about z of radius `bend`, in steps far shorter than the vessel is wide.
VesselGraph helix(double bend, double radius, double rise) {
  VesselGraph graph;
  const int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double phi = i * 4.0 * std::numbers::pi / steps;
    graph.points.emplace_back(bend * std::cos(phi), bend * std::sin(phi), rise * i / steps);
    if (i > 0) graph.edges.push_back({i - 1, i, radius, radius});
  }
  return graph;
}

TEST(GraphOverlaps, ABendIsNoneButAWindingThatMeetsTheFirstIs) {
  // Two windings of a helix: 2.2 mm apart they clear vessels of 2 mm diameter, 1.6 mm apart they do not.
  EXPECT_TRUE(overlaps_of(helix(3.0, 1.0, 4.4)).empty());
  const std::vector<GraphOverlap> found = overlaps_of(helix(3.0, 1.0, 3.2));
  ASSERT_FALSE(found.empty());
  for (const GraphOverlap& o : found) {
    EXPECT_GT(o.second - o.first, 100);
    EXPECT_LT(o.depth_mm, 0.5);
  }
}

TEST(GraphOverlaps, ForksAreNone) {
  EXPECT_TRUE(overlaps_of(binary_tree(3, 0.9, 0.1)).empty());
  // The same in fine steps: the first of either child's pieces lie within their parent and each other.
  const VesselGraph coarse = graph_of({{0, 0, 0}, {9, 0, 0}, {18, 6, 0}, {18, -6, 0}},
                                      {{0, 1, 1, 1}, {1, 2, 0.8, 0.8}, {1, 3, 0.8, 0.8}});
  VesselGraph fine;
  fine.points = coarse.points;
  for (const GraphEdge& e : coarse.edges) {
    std::int32_t before = e.from;
    for (int k = 1; k <= 50; ++k) {
      const Vec3 from = coarse.points[static_cast<std::size_t>(e.from)];
      const Vec3 to = coarse.points[static_cast<std::size_t>(e.to)];
      std::int32_t next = e.to;
      if (k < 50) {
        next = static_cast<std::int32_t>(fine.points.size());
        fine.points.push_back(from + (to - from) * (k / 50.0));
      }
      fine.edges.push_back({before, next, e.radius_from, e.radius_to});
      before = next;
    }
  }
  EXPECT_TRUE(overlaps_of(fine).empty());
  OverlapOptions strict;
  strict.bend_reach = strict.fork_reach = 0.0;
  EXPECT_FALSE(overlaps_of(fine, strict).empty());
}

TEST(GraphOverlaps, AreThoseOfAllPairsForAnyNumberOfThreads) {
  std::mt19937 random(11);
  const auto number = [&] { return static_cast<double>(random()) / 4294967295.0; };
  VesselGraph graph;
  for (std::int32_t i = 0; i < 9000; ++i) {
    const Vec3 at(40 * number(), 40 * number(), 40 * number());
    graph.points.push_back(at);
    graph.points.push_back(at + Vec3(number() - 0.5, number() - 0.5, number() - 0.5) * 2.0);
    graph.edges.push_back({2 * i, 2 * i + 1, 0.5 * number(), 0.5 * number()});
  }
  graph.points[1] = graph.points[0] + Vec3(40, 40, 40);  // one that goes all through
  std::vector<std::pair<std::int32_t, std::int32_t>> all;
  for (std::int32_t a = 0; a < 9000; a += 30)
    for (std::int32_t b = a + 1; b < 9000; ++b) {
      const auto hit = contact(round_cone(graph, a), round_cone(graph, b));
      if (hit && hit->depth > 1e-3) all.emplace_back(a, b);
    }
  const auto found_by = [&](int threads) {
    core::set_max_threads(threads);
    std::vector<std::pair<std::int32_t, std::int32_t>> found;
    for (const GraphOverlap& o : overlaps_of(graph))
      if (o.first % 30 == 0 && o.depth_mm > 1e-3) found.emplace_back(o.first, o.second);
    core::set_max_threads(0);
    return found;
  };
  EXPECT_GT(all.size(), 20U);
  EXPECT_EQ(found_by(1), all);
  EXPECT_EQ(found_by(3), all);
}

TEST(GraphOverlaps, RefusesBadNumbersAndIsCancelled) {
  VesselGraph graph = line_of(3);
  EXPECT_TRUE(overlaps_of(graph).empty());
  EXPECT_TRUE(overlaps_of(VesselGraph{}).empty());
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(find_overlaps(graph, geometry::GraphIncidence(graph), {}, task), Cancelled);
  graph.edges[1].radius_from = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(overlaps_of(graph), InvalidInput);
  OverlapOptions options;
  options.fork_reach = -1.0;
  EXPECT_THROW(overlaps_of(line_of(2), options), InvalidInput);
}

}  // namespace
