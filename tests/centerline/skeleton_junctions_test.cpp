#include "support/masks.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/centerline/skeleton_radius.h"
#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::centerline {
namespace {

using test::graph_of;
using test::grid_of;
using test::mask_of;

/// Straight lines from `ends` towards `crossing` that all turn away to `wrong` over their last 2 mm.
SkeletonGraph star(const std::vector<Vec3>& ends, const Vec3& crossing, const Vec3& wrong, double radius) {
  SkeletonGraph graph;
  graph.nodes.push_back({0, wrong, SkeletonNodeKind::junction, radius});
  for (const Vec3& end : ends) {
    const auto id = static_cast<std::int32_t>(graph.nodes.size());
    graph.nodes.push_back({id, end, SkeletonNodeKind::end, radius});
    SkeletonEdge edge{id - 1, id, 0, {}, {}};
    const Vec3 way = crossing - end;
    const int steps = static_cast<int>(way.norm() / 0.5);
    for (int i = 0; i <= steps; ++i) {
      const Vec3 p = end + way * (static_cast<double>(i) / steps);
      if ((crossing - p).norm() >= 2.0) edge.points.push_back(p);
    }
    edge.points.push_back(wrong);
    edge.radius_mm.assign(edge.points.size(), radius);
    graph.edges.push_back(std::move(edge));
  }
  return graph;
}

TEST(JunctionsSettled, LieWhereTheLinesThatGoOnMeet) {
  const Vec3 crossing(1.0, 2.0, 3.0);
  const SkeletonGraph graph =
      star({{1, 2, -20}, {14, 2, 18}, {-12, 6, 15}}, crossing, Vec3(1.6, 1.5, 3.8), 1.5);
  ASSERT_EQ(find_fault(graph), std::nullopt);
  const SkeletonGraph settled = junctions_settled(graph);
  EXPECT_EQ(find_fault(settled), std::nullopt);
  EXPECT_LT((settled.nodes[0].position - crossing).norm(), 0.06);
  ASSERT_EQ(settled.edges.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(settled.edges[i].id, graph.edges[i].id);
    EXPECT_EQ(settled.edges[i].from, graph.edges[i].from);
    EXPECT_EQ(settled.edges[i].points.front(), graph.edges[i].points.front());
    EXPECT_NEAR(length_mm(settled.edges[i]), (crossing - settled.edges[i].points.front()).norm(), 0.06);
    for (const double r : settled.edges[i].radius_mm) EXPECT_DOUBLE_EQ(r, 1.5);
  }
}

TEST(JunctionsSettled, SmoothLinesDoNotSwingOnTheStraightWays) {
  const SkeletonGraph graph =
      star({{1, 2, -20}, {14, 2, 18}, {-12, 6, 15}}, Vec3(1.0, 2.0, 3.0), Vec3(1.6, 1.5, 3.8), 3.0);
  const SkeletonGraph settled = junctions_settled(graph);
  const SkeletonGraph smooth = smoothed(settled, {.knot_spacing_mm = 1.0});
  for (std::size_t i = 0; i < 3; ++i) {
    const std::vector<Vec3>& line = settled.edges[i].points;
    for (std::size_t k = 1; k < line.size(); ++k) EXPECT_LT((line[k] - line[k - 1]).norm(), 0.6);
    for (const Vec3& p : smooth.edges[i].points)
      EXPECT_LT((geometry::closest(line, p).point - p).norm(), 0.1);
  }
}

TEST(JunctionsSettled, MoveNoFartherThanTheyMayAndKeepTheirDirections) {
  const Vec3 crossing(0.0, 0.0, 0.0), wrong(2.0, 0.0, 0.0);
  SkeletonGraph graph = star({{0, 0, -20}, {14, 0, 18}, {-12, 6, 15}}, crossing, wrong, 1.0);
  graph.oriented = true;
  const SkeletonGraph settled = junctions_settled(graph, {.most_radii = 0.5});
  EXPECT_NEAR((settled.nodes[0].position - wrong).norm(), 0.5, 1e-9);
  EXPECT_TRUE(settled.oriented);
  const SkeletonGraph same = junctions_settled(graph, {.most_radii = 0.0});
  EXPECT_LT((same.nodes[0].position - wrong).norm(), 1e-12);
}

TEST(JunctionsSettled, LinesThatRunSideBySideDoNotCarryTheJunctionAway) {
  // Nearly parallel: where they meet is not known along them.
  const Vec3 crossing(0.0, 0.0, 0.0);
  const SkeletonGraph graph =
      star({{0, 0, -20}, {0.3, 0, -25}, {0, 0, 20}}, crossing, Vec3(0.4, 0.3, 0.0), 1.0);
  const SkeletonGraph settled = junctions_settled(graph);
  EXPECT_EQ(find_fault(settled), std::nullopt);
  EXPECT_LT(std::abs(settled.nodes[0].position.z()), 0.5);
  EXPECT_LT(std::hypot(settled.nodes[0].position.x(), settled.nodes[0].position.y()), 0.1);
}

TEST(JunctionsSettled, TwoThatAreNearEachOtherStayTwo) {
  SkeletonGraph graph;
  graph.nodes = {{0, Vec3(0, 0, -0.3), SkeletonNodeKind::junction, 2.0},
                 {1, Vec3(0, 0, 0.3), SkeletonNodeKind::junction, 2.0}};
  graph.edges = {{0, 0, 1, {Vec3(0, 0, -0.3), Vec3(0, 0, 0.3)}, {2.0, 2.0}}};
  std::int32_t next = 2;
  for (const Vec3& end : {Vec3(0, 8, -20), Vec3(0, -8, -20), Vec3(8, 0, 20), Vec3(-8, 0, 20)}) {
    graph.nodes.push_back({next, end, SkeletonNodeKind::end, 1.0});
    const std::int32_t node = end.z() < 0.0 ? 0 : 1;
    graph.edges.push_back(
        {next - 1, node, next, {graph.nodes[static_cast<std::size_t>(node)].position, end}, {2.0, 1.0}});
    ++next;
  }
  ASSERT_EQ(find_fault(graph), std::nullopt);
  const SkeletonGraph settled = junctions_settled(graph);
  EXPECT_EQ(find_fault(settled), std::nullopt);
  EXPECT_LT((settled.nodes[0].position - settled.nodes[1].position).norm(), 1.2);
}

TEST(JunctionsSettled, OfAVoxelisedForkIsNearerToItsAxesThanTheThinnedOne) {
  // 0.6 x 0.6 x 1.25 mm: what thinning makes of it lies up to a slice off.
  const Vec3 voxel(0.6, 0.6, 1.25), crossing(21.0, 20.0, 24.0);
  double before = 0.0, after = 0.0;
  for (int turn = 0; turn < 6; ++turn) {
    const double a = 0.5 + turn;
    const Vec3 low = crossing + 18.0 * Vec3(0.2 * std::cos(a), 0.2 * std::sin(a), -0.95).normalized();
    const Vec3 left = crossing + 18.0 * Vec3(std::cos(a), std::sin(a), 0.9).normalized();
    const Vec3 right = crossing + 18.0 * Vec3(-std::cos(a + 0.5), -std::sin(a + 0.5), 0.6).normalized();
    const imaging::MaskVolume mask = mask_of(grid_of(70, 68, 40, voxel), [&](const Vec3& p) {
      return test::to_segment(p, low, crossing) <= 2.0 || test::to_segment(p, left, crossing) <= 1.5 ||
             test::to_segment(p, right, crossing) <= 1.2;
    });
    const SkeletonGraph lines = smoothed(ends_extended(pruned(graph_of(mask)), mask));
    const auto junctions = [](const SkeletonGraph& graph) {
      return test::nodes_of(graph, SkeletonNodeKind::junction);
    };
    ASSERT_EQ(junctions(lines).size(), 1U);
    const SkeletonGraph settled = junctions_settled(measured(lines, mask).graph);
    before = std::max(before, (junctions(lines)[0].position - crossing).norm());
    after = std::max(after, (junctions(settled)[0].position - crossing).norm());
  }
  RecordProperty("before_um", static_cast<int>(1000.0 * before));
  RecordProperty("after_um", static_cast<int>(1000.0 * after));
  EXPECT_GT(before, 0.8);
  EXPECT_LT(after, 0.45);
}

TEST(JunctionsSettled, RefusesOptionsOutOfRange) {
  const SkeletonGraph graph = star({{0, 0, -9}, {9, 0, 9}, {-9, 0, 9}}, Vec3::Zero(), Vec3::Zero(), 1.0);
  EXPECT_THROW(junctions_settled(graph, {.trimmed_radii = -1.0}), InvalidInput);
  EXPECT_THROW(junctions_settled(graph, {.direction_mm = 0.0}), InvalidInput);
  EXPECT_THROW(junctions_settled(graph, {.most_radii = 99.0}), InvalidInput);
}

TEST(EndsExtended, KeepsTheFlowsDirection) {
  const imaging::MaskVolume mask = mask_of(grid_of(20, 20, 50), [](const Vec3& p) {
    return test::in_tube(p, Vec3(9.6, 9.3, 8.0), Vec3(9.6, 9.3, 42.0), 2.5);
  });
  const SkeletonGraph flow = oriented(pruned(graph_of(mask)), {Vec3(9.6, 9.3, 42.0)}).graph;
  ASSERT_EQ(flow.edges.size(), 1U);
  ASSERT_GT(flow.edges[0].points.front().z(), flow.edges[0].points.back().z());
  const SkeletonGraph longer = ends_extended(flow, mask);
  EXPECT_TRUE(longer.oriented);
  EXPECT_EQ(longer.edges[0].from, flow.edges[0].from);
  EXPECT_NEAR(longer.edges[0].points.front().z(), 42.0, 0.8);
  EXPECT_NEAR(longer.edges[0].points.back().z(), 8.0, 0.8);
}

}  // namespace
}  // namespace ostia::centerline
