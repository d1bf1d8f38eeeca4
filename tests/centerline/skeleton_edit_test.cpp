#include "ostia/centerline/skeleton_edit.h"

#include "support/masks.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace ostia::centerline {
namespace {

using imaging::MaskVolume;
using test::graph_of;
using test::grid_of;
using test::mask_of;
using test::nodes_of;
using ::testing::HasSubstr;

/// Lines through points; equal ends are one node.
SkeletonGraph drawn(const std::vector<std::vector<Vec3>>& lines, double radius = 1.0) {
  SkeletonGraph graph;
  const auto node_at = [&](const Vec3& p) {
    for (const SkeletonNode& n : graph.nodes)
      if (n.position == p) return n.id;
    graph.nodes.push_back(
        {static_cast<std::int32_t>(graph.nodes.size()), p, SkeletonNodeKind::point, radius});
    return graph.nodes.back().id;
  };
  for (const auto& line : lines) {
    const std::int32_t a = node_at(line.front()), b = node_at(line.back());
    graph.edges.push_back({static_cast<std::int32_t>(graph.edges.size()), a, b, line,
                           std::vector<double>(line.size(), radius)});
  }
  for (SkeletonNode& n : graph.nodes) {
    std::size_t degree = 0;
    bool ring = false;
    for (const SkeletonEdge& e : graph.edges) {
      degree += (e.from == n.id ? 1U : 0U) + (e.to == n.id ? 1U : 0U);
      ring = ring || (e.from == n.id && e.to == n.id);
    }
    n.kind = degree == 1           ? SkeletonNodeKind::end
             : degree == 2 && ring ? SkeletonNodeKind::loop_anchor
             : degree == 2         ? SkeletonNodeKind::passage
                                   : SkeletonNodeKind::junction;
  }
  return graph;
}

const std::vector<Vec3> trunk_low{{0, 0, 0}, {0, 0, 10}}, trunk_high{{0, 0, 10}, {0, 0, 30}};

std::string edit_message(const std::function<void()>& command) {
  try {
    command();
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(Pruned, ShortLeavesGoAndTheTrunkIsOneLine) {
  const SkeletonGraph graph = drawn({trunk_low, trunk_high, {{0, 0, 10}, {4.9, 0, 10}}});
  const SkeletonGraph less = pruned(graph);
  EXPECT_EQ(find_fault(less), std::nullopt);
  ASSERT_EQ(less.edges.size(), 1U);
  EXPECT_DOUBLE_EQ(length_mm(less.edges[0]), 30.0);
  EXPECT_EQ(pruned(drawn({trunk_low, trunk_high, {{0, 0, 10}, {5.1, 0, 10}}})).edges.size(), 3U);
  EXPECT_EQ(pruned(graph, {.length_mm = 4.0}).edges.size(), 3U);
}

TEST(Pruned, ALeafWithinAWideVesselIsNoise) {
  const SkeletonGraph wide = drawn({trunk_low, trunk_high, {{0, 0, 10}, {6.5, 0, 10}}}, 7.0);
  EXPECT_EQ(pruned(wide).edges.size(), 1U);
  EXPECT_EQ(pruned(wide, {.junction_radii = 0.0}).edges.size(), 3U);
}

TEST(Pruned, OfAForkOfShortLeavesTheLongerLivesOn) {
  const SkeletonGraph less = pruned(drawn({trunk_high, {{0, 0, 10}, {2, 0, 8}}, {{0, 0, 10}, {0, 3, 8}}}));
  ASSERT_EQ(less.edges.size(), 1U);
  EXPECT_NEAR(length_mm(less.edges[0]), 20.0 + std::sqrt(13.0), 1e-9);
}

TEST(Pruned, LoopsAndIfAskedFragmentsStay) {
  const SkeletonGraph graph = drawn({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, {{9, 0, 0}, {9, 0, 3}}});
  const SkeletonGraph less = pruned(graph);
  EXPECT_EQ(component_count(less), 1);
  EXPECT_EQ(loop_count(less), 1);
  EXPECT_EQ(component_count(pruned(graph, {.isolated = false})), 2);
}

TEST(EndsExtended, ATubeGetsItsLength) {
  const Vec3 a(8.0, 9.0, 6.0), b(20.0, 14.0, 38.0);
  for (const double radius : {1.5, 3.0}) {
    for (const Vec3& spacing : {Vec3(0.5, 0.5, 0.5), Vec3(0.6, 0.6, 1.25)}) {
      const auto n = [&](int d) { return static_cast<std::int64_t>(45.0 / spacing[d]); };
      const MaskVolume mask = mask_of(grid_of(n(0), n(1), n(2), spacing),
                                      [&](const Vec3& p) { return test::in_tube(p, a, b, radius); });
      const SkeletonGraph graph = smoothed(ends_extended(pruned(graph_of(mask)), mask));
      ASSERT_EQ(graph.edges.size(), 1U);
      EXPECT_NEAR(length_mm(graph.edges[0]), (b - a).norm(), spacing.maxCoeff());
    }
  }
}

TEST(EndsExtended, AStubReachesTheWallToo) {
  const Vec3 middle = Vec3::Constant(6.0);
  const MaskVolume ball = mask_of(grid_of(25, 25, 25, Vec3::Constant(0.5)),
                                  [&](const Vec3& p) { return (p - middle).norm() <= 4.0; });
  const SkeletonGraph stub = drawn({{middle - Vec3(1, 0, 0), middle, middle + Vec3(1, 0, 0)}}, 4.0);
  const SkeletonGraph longer = ends_extended(stub, ball);
  EXPECT_EQ(find_fault(longer), std::nullopt);
  for (const SkeletonNode& end : longer.nodes) EXPECT_NEAR((end.position - middle).norm(), 4.0, 0.3);
}

TEST(GapsClosed, AGapOfATubeByItsWidth) {
  for (const double gap : {1.5, 3.0}) {
    const Vec3 a(6.0, 6.0, 3.0), direction = Vec3(0.1, 0.05, 1.0).normalized();
    const MaskVolume mask = mask_of(grid_of(28, 28, 90, Vec3(0.5, 0.5, 0.5)), [&](const Vec3& p) {
      return test::in_tube(p, a, a + 18.0 * direction, 1.5) ||
             test::in_tube(p, a + (18.0 + gap) * direction, a + 36.0 * direction, 1.5);
    });
    const SkeletonGraph ends = ends_extended(pruned(graph_of(mask)), mask);
    EXPECT_EQ(component_count(ends), 2);
    const SkeletonGraph closed = gaps_closed(ends);
    EXPECT_EQ(find_fault(closed), std::nullopt);
    EXPECT_EQ(component_count(closed), gap < 2.0 ? 1 : 2) << gap;
    EXPECT_EQ(component_count(gaps_closed(ends, {.distance_mm = 4.0})), 1);
    if (gap < 2.0) {
      EXPECT_NEAR(length_mm(smoothed(closed).edges.at(0)), 36.0, 1.0);
    }
  }
}

TEST(GapsClosed, NotAroundACorner) {
  const std::vector<Vec3> up{{0, 0, 0}, {0, 0, 10}};
  const SkeletonGraph corner = drawn({up, {{0.0, 1.5, 10.0}, {0.0, 11.5, 10.0}}});
  EXPECT_EQ(component_count(gaps_closed(corner)), 2);
  EXPECT_EQ(component_count(gaps_closed(corner, {.angle_deg = 100.0})), 1);
  // Side by side.
  EXPECT_EQ(component_count(gaps_closed(drawn({up, {{1, 0, 0}, {1, 0, 10}}}))), 2);
}

TEST(GapsClosed, TheNearestFirstAndEachEndOnce) {
  const SkeletonGraph graph =
      drawn({{{0, 0, 0}, {0, 0, 10}}, {{0.2, 0, 11.0}, {0.2, 0, 20}}, {{0, 0, 11.9}, {0, 3, 20}}});
  const SkeletonGraph closed = gaps_closed(graph);
  EXPECT_EQ(component_count(closed), 2);
  EXPECT_EQ(closed.edges.size(), 2U);
  EXPECT_NEAR(length_mm(closed.edges[0]), 10.0 + std::hypot(1.0, 0.2) + 9.0, 1e-9);
}

TEST(Connected, ALineBetweenTwoPlaces) {
  const SkeletonGraph two = drawn({{{0, 0, 0}, {0, 0, 20}}, {{8, 0, 0}, {8, 0, 20}}});
  const SkeletonGraph bridge = connected(two, Vec3(0.3, 0, 10), Vec3(7.8, 0, 12));
  EXPECT_EQ(find_fault(bridge), std::nullopt);
  EXPECT_EQ(component_count(bridge), 1);
  EXPECT_EQ(nodes_of(bridge, SkeletonNodeKind::junction).size(), 2U);
  EXPECT_EQ(bridge.edges.size(), 5U);
  EXPECT_EQ(two.edges.size(), 2U);
  const SkeletonGraph ends = connected(two, Vec3(0, 0, 20.2), Vec3(8, 0, 20.1));
  ASSERT_EQ(ends.edges.size(), 1U);
  EXPECT_NEAR(length_mm(ends.edges[0]), 48.0, 1e-9);
  EXPECT_EQ(loop_count(connected(ends, Vec3(0, 0, 0), Vec3(8, 0, 0))), 1);
}

TEST(Cut, ALineBecomesTwoAndALoopOpens) {
  const SkeletonGraph one = drawn({{{0, 0, 0}, {0, 0, 20}}});
  const SkeletonGraph two = cut(one, Vec3(0.5, 0, 8));
  EXPECT_EQ(find_fault(two), std::nullopt);
  EXPECT_EQ(component_count(two), 2);
  EXPECT_EQ(nodes_of(two, SkeletonNodeKind::end).size(), 4U);
  EXPECT_NEAR(test::total_length(two), 20.0, 1e-9);
  const SkeletonGraph ring = drawn({{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}}});
  for (const Vec3& place : {Vec3(0, 0, 0), Vec3(9, 4, 0)}) {
    const SkeletonGraph open = cut(ring, place);
    EXPECT_EQ(find_fault(open), std::nullopt);
    EXPECT_EQ(loop_count(open), 0);
    EXPECT_EQ(component_count(open), 1);
    EXPECT_NEAR(test::total_length(open), 36.0, 1e-9);
  }
}

TEST(Removed, AnEdgeAndWhatOnlyItHad) {
  const SkeletonGraph graph = drawn({trunk_low, trunk_high, {{0, 0, 10}, {9, 0, 10}}});
  const SkeletonGraph less = removed(graph, 2);
  EXPECT_EQ(find_fault(less), std::nullopt);
  ASSERT_EQ(less.edges.size(), 1U);
  EXPECT_EQ(less.nodes.size(), 2U);
  EXPECT_TRUE(removed(less, 0).nodes.empty());
}

TEST(LoopsOpened, TheThinnestLineOfEachLoopGoes) {
  // A trunk, two ways from (0, 0, 10) to (0, 0, 30), the longer one thin, and a thin leaf, which stays.
  SkeletonGraph graph = drawn({{{0, 0, 0}, {0, 0, 10}},
                               {{0, 0, 10}, {0, 0, 30}},
                               {{0, 0, 10}, {9, 0, 20}, {0, 0, 30}},
                               {{0, 0, 30}, {0, 0, 40}},
                               {{0, 0, 30}, {0, 9, 30}}});
  graph.edges[2].radius_mm = {1.0, 0.2, 1.0};
  graph.edges[4].radius_mm = {0.1, 0.1};
  const SkeletonGraph open = loops_opened(graph);
  EXPECT_EQ(find_fault(open), std::nullopt);
  EXPECT_EQ(loop_count(open), 0);
  EXPECT_EQ(component_count(open), 1);
  EXPECT_NEAR(test::total_length(open), 49.0, 1e-9);
  EXPECT_EQ(open.edges.size(), 3U) << "what is left on both sides of (0, 0, 10) is one line";
}

TEST(LoopsOpened, LinesThatOnlyBecomeOneByItKeepTheirOwnRadii) {
  // Two loops that share the node (0, 0, 0): after the first is open, its node has three lines.
  SkeletonGraph graph = drawn({{{0, 0, 0}, {9, 0, 0}},
                               {{0, 0, 0}, {5, 5, 0}, {9, 0, 0}},
                               {{0, 0, 0}, {-9, 0, 0}},
                               {{0, 0, 0}, {-5, 5, 0}, {-9, 0, 0}}});
  for (const std::size_t thin : {1U, 3U}) graph.edges[thin].radius_mm = {0.5, 0.5, 0.5};
  const SkeletonGraph open = loops_opened(graph);
  EXPECT_EQ(find_fault(open), std::nullopt);
  EXPECT_EQ(loop_count(open), 0);
  ASSERT_EQ(open.edges.size(), 1U);
  EXPECT_NEAR(length_mm(open.edges[0]), 18.0, 1e-9);
}

TEST(LoopsOpened, ATreeStaysAndAClosedLineGoesWhole) {
  const SkeletonGraph tree = drawn({trunk_low, trunk_high, {{0, 0, 10}, {9, 0, 10}}});
  EXPECT_EQ(loops_opened(tree).edges.size(), 3U);
  const SkeletonGraph ring = drawn({{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {0, 0, 0}}});
  EXPECT_TRUE(loops_opened(ring).edges.empty());
  EXPECT_TRUE(loops_opened(ring).nodes.empty());
}

TEST(EdgeAt, IsTheNearestLineAlsoAtItsEnds) {
  const SkeletonGraph graph = drawn({trunk_low, trunk_high, {{0, 0, 10}, {9, 0, 10}}});
  EXPECT_EQ(edge_at(graph, Vec3(0.5, 0, 4)), 0);
  EXPECT_EQ(edge_at(graph, Vec3(0.4, 0, 25)), 1);
  EXPECT_EQ(edge_at(graph, Vec3(9.5, 0, 10)), 2);
  EXPECT_EQ(edge_at(graph, Vec3(0, 0, 33)), 1);
  EXPECT_THAT(edit_message([&] { edge_at(graph, Vec3(40, 0, 0)); }), HasSubstr("off the skeleton"));
}

TEST(Commands, RefuseWhatMakesNoSense) {
  const SkeletonGraph graph = drawn({trunk_low, trunk_high, {{0, 0, 10}, {9, 0, 10}}});
  const Vec3 far(40, 0, 0), bad(std::nan(""), 0, 0);
  EXPECT_THAT(edit_message([&] { connected(graph, far, Vec3::Zero()); }), HasSubstr("off the skeleton"));
  EXPECT_THAT(edit_message([&] { connected(graph, Vec3(0, 0, 0.2), Vec3::Zero()); }),
              HasSubstr("the same one"));
  EXPECT_THAT(edit_message([&] { connected(graph, bad, Vec3::Zero()); }), HasSubstr("not finite"));
  EXPECT_THAT(edit_message([&] { cut(graph, Vec3(0, 0, 10.2)); }), HasSubstr("away from its nodes"));
  EXPECT_THAT(edit_message([&] { cut(graph, far); }), HasSubstr("off the skeleton"));
  EXPECT_THAT(edit_message([&] { cut(SkeletonGraph{}, far); }), HasSubstr("empty"));
  EXPECT_THAT(edit_message([&] { removed(graph, 99); }), HasSubstr("no edge 99"));
  EXPECT_THAT(edit_message([&] { pruned(graph, {.length_mm = -1.0}); }), HasSubstr("length_mm is -1"));
  EXPECT_THAT(edit_message([&] { gaps_closed(graph, {.angle_deg = 0.0}); }), HasSubstr("angle_deg is 0"));
  EXPECT_THAT(edit_message([&] { ends_extended(graph, {}); }), HasSubstr("does not fit"));
  EXPECT_THAT(edit_message([&] { smoothed(graph, {.knot_spacing_mm = 0.0}); }),
              HasSubstr("knot_spacing_mm is 0"));
}

}  // namespace
}  // namespace ostia::centerline
