#include "ostia/geometry/graph_repair.h"

#include "test_graphs.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace ostia::geometry {
namespace {

constexpr double nan_graph_repair = std::numeric_limits<double>::quiet_NaN();

std::size_t graph_repair_step(const RepairedGraph& fixed, const std::string& what) {
  for (const GraphRepairStep& s : fixed.steps)
    if (s.what == what) return s.count;
  return 0;
}

void expect_same(const VesselGraph& a, const VesselGraph& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]) << i;
  for (std::size_t e = 0; e < a.edges.size(); ++e) {
    EXPECT_EQ(a.edges[e].from, b.edges[e].from) << e;
    EXPECT_EQ(a.edges[e].to, b.edges[e].to) << e;
    EXPECT_EQ(a.edges[e].radius_from, b.edges[e].radius_from) << e;
    EXPECT_EQ(a.edges[e].radius_to, b.edges[e].radius_to) << e;
  }
  EXPECT_EQ(a.references, b.references);
}

TEST(GraphRepair, LeavesWhatIsSoundAsItIs) {
  const RepairedGraph fixed = repaired(y_graph());
  EXPECT_TRUE(fixed.steps.empty());
  EXPECT_TRUE(fixed.left.found.empty());
  expect_same(fixed.graph, y_graph());
}

// Reversed, shuffled, every end of a segment a point of its own: the same tree comes back.
TEST(GraphRepair, PutsATreeTogetherAgain) {
  const VesselGraph whole = y_graph();
  VesselGraph apart;
  for (const std::size_t e : {3u, 0u, 4u, 2u, 1u}) {
    GraphEdge edge = whole.edges[e];
    const auto n = static_cast<std::int32_t>(apart.points.size());
    apart.points.push_back(whole.points[static_cast<std::size_t>(edge.from)]);
    apart.points.push_back(whole.points[static_cast<std::size_t>(edge.to)]);
    if (e % 2 == 0) {
      std::swap(apart.points[static_cast<std::size_t>(n)], apart.points[static_cast<std::size_t>(n) + 1]);
      std::swap(edge.radius_from, edge.radius_to);
    }
    apart.edges.push_back({n, n + 1, edge.radius_from, edge.radius_to});
    apart.references.push_back(whole.references[e]);
  }
  const RepairedGraph fixed = repaired(apart);
  EXPECT_EQ(graph_repair_step(fixed, "points_joined"), 4u);
  EXPECT_EQ(graph_repair_step(fixed, "turned"), 3u);
  EXPECT_TRUE(fixed.left.sound_tree());
  EXPECT_EQ(facts_of(fixed.graph).forks, 1u);
  EXPECT_EQ(facts_of(fixed.graph).largest_radius_mm, 2.0);
  EXPECT_EQ(fixed.graph.points[0], Vec3(0, 0, 0)) << "the end of greatest radius is the root";
  std::vector<std::int64_t> references = fixed.graph.references;
  std::sort(references.begin(), references.end());
  EXPECT_EQ(references, whole.references);
  EXPECT_EQ(fixed.graph.references[0], 11);
}

TEST(GraphRepair, DropsWhatIsNoSegment) {
  VesselGraph graph = y_graph();
  graph.points.push_back({nan_graph_repair, 0, 0});
  graph.edges.push_back({2, 6, 1, 1});
  graph.edges.push_back({-1, 0, 1, 1});
  graph.edges.push_back({4, 4, 1, 1});
  graph.edges.push_back({1, 0, 1, 1});
  graph.references.insert(graph.references.end(), {1, 2, 3, 4});
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(graph_repair_step(fixed, "non_finite_dropped"), 1u);
  EXPECT_EQ(graph_repair_step(fixed, "index_out_of_range_dropped"), 1u);
  EXPECT_EQ(graph_repair_step(fixed, "zero_length_dropped"), 1u);
  EXPECT_EQ(graph_repair_step(fixed, "duplicate_dropped"), 1u);
  EXPECT_EQ(fixed.steps.front().text, "segments that named points which are not there dropped: 1");
  expect_same(fixed.graph, y_graph());
}

TEST(GraphRepair, JoinsNearPointsWhenAskedTo) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {1, 0, 0}, {1, 0.004, 0}, {2, 0, 0}};
  graph.edges = {{0, 1, 1, 1}, {2, 3, 1, 1}};
  EXPECT_EQ(facts_of(repaired(graph).graph).parts, 2u);
  GraphRepairOptions near;
  near.merge_within_mm = 0.005;
  const RepairedGraph fixed = repaired(graph, near);
  EXPECT_EQ(facts_of(fixed.graph).parts, 1u);
  EXPECT_EQ(fixed.graph.points.size(), 3u);
}

TEST(GraphRepair, FillsRadiiFromNeighbours) {
  VesselGraph graph = y_graph();
  graph.edges[2].radius_from = -3.0;  // at the fork 1.5 arrives and 0.75 leaves
  graph.edges[4].radius_to = 0.0;     // an end: the segment's own other radius
  graph.edges[1] = {1, 2, nan_graph_repair, 1.5};
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(graph_repair_step(fixed, "radii_filled"), 3u);
  EXPECT_DOUBLE_EQ(fixed.graph.edges[2].radius_from, 1.125);
  EXPECT_DOUBLE_EQ(fixed.graph.edges[4].radius_to, 0.5);
  EXPECT_DOUBLE_EQ(fixed.graph.edges[1].radius_from, 1.75);
  EXPECT_TRUE(fixed.left.sound_tree());
}

// The only radius at a place is that of a segment without length, which goes itself.
TEST(GraphRepair, TakesTheRadiusOfWhatItDrops) {
  VesselGraph graph = y_graph();
  graph.edges[4].radius_to = -1.0;
  graph.edges.push_back({5, 5, 0.125, 0.125});
  graph.references.push_back(16);
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(graph_repair_step(fixed, "zero_length_dropped"), 1u);
  EXPECT_EQ(fixed.graph.edges[4].radius_to, 0.125);
}

// One radius is known at the far end of a long chain, and none in a second part.
TEST(GraphRepair, RadiiReachAlongALongChainAndNoFurther) {
  VesselGraph graph;
  for (int i = 0; i < 50000; ++i) graph.points.emplace_back(i, 0, 0);
  for (std::int32_t i = 0; i + 1 < 50000; ++i)
    graph.edges.push_back({i, i + 1, nan_graph_repair, nan_graph_repair});
  graph.edges.back().radius_to = 0.5;
  graph.points.insert(graph.points.end(), {{0, 9, 0}, {1, 9, 0}});
  graph.edges.push_back({50000, 50001, 0.0, nan_graph_repair});
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(graph_repair_step(fixed, "radii_filled"), 49999u);
  EXPECT_EQ(fixed.graph.edges[0].radius_from, 0.5);
  EXPECT_EQ(fixed.left.count(GraphFaultKind::zero_radius), 1u);
  EXPECT_EQ(fixed.left.count(GraphFaultKind::missing_radius), 1u);
}

TEST(GraphRepair, TurnsAwayFromAGivenRoot) {
  GraphRepairOptions options;
  options.roots = {Vec3(3.1, 4, 14)};  // near point 3
  const RepairedGraph fixed = repaired(y_graph(), options);
  EXPECT_EQ(graph_repair_step(fixed, "turned"), 3u);
  EXPECT_EQ(fixed.graph.points[0], Vec3(3, 4, 14));
  EXPECT_EQ(fixed.graph.edges[0].radius_from, 1.0);
  EXPECT_EQ(fixed.graph.edges[0].radius_to, 1.25);
  EXPECT_TRUE(fixed.left.sound_tree());
}

// Two vessels that flow together are no fault where directions are to be kept.
TEST(GraphRepair, KeepsDirectionsWhenAskedTo) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 2, 0}};
  graph.edges = {{0, 2, 1, 1}, {1, 2, 0.9, 0.9}, {2, 3, 1.2, 1.2}};
  GraphRepairOptions options;
  options.keep_directions = true;
  EXPECT_EQ(graph_repair_step(repaired(graph, options), "turned"), 0u);
  const RepairedGraph turned = repaired(graph);
  EXPECT_EQ(graph_repair_step(turned, "turned"), 3u);
  EXPECT_EQ(turned.graph.points[0], Vec3(1, 2, 0));
}

TEST(GraphRepair, LoopsStayAndAreTold) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  graph.edges = {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 3, 1, 1}, {3, 0, 1, 1}};
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(fixed.left.count(GraphFaultKind::cycle), 1u);
  EXPECT_EQ(fixed.left.count(GraphFaultKind::no_root), 0u) << "turned from its point of greatest radius";
  EXPECT_EQ(fixed.graph.edges.size(), 4u);
}

TEST(GraphRepair, ParentsComeBeforeTheirChildren) {
  VesselGraph graph;
  for (int i = 0; i < 200; ++i) graph.points.emplace_back(i % 7, i % 11, i);
  for (std::int32_t i = 1; i < 200; ++i) graph.edges.push_back({(i * 7919 % 1009) % i, i, 1.0, 1.0});
  std::reverse(graph.edges.begin(), graph.edges.end());
  ASSERT_TRUE(put_in_order(graph));
  std::vector<bool> reached(200, false);
  reached[0] = true;
  for (const GraphEdge& edge : graph.edges) {
    EXPECT_TRUE(reached[static_cast<std::size_t>(edge.from)]);
    EXPECT_LT(edge.from, edge.to);
    reached[static_cast<std::size_t>(edge.to)] = true;
  }
  EXPECT_FALSE(put_in_order(graph)) << "once is enough";
}

TEST(GraphRepair, RefusesOptionsAndNothing) {
  GraphRepairOptions options;
  options.merge_within_mm = -1.0;
  EXPECT_THROW(repaired(y_graph(), options), InvalidInput);
  options.merge_within_mm = 0.0;
  options.roots = {Vec3(nan_graph_repair, 0, 0)};
  EXPECT_THROW(repaired(y_graph(), options), InvalidInput);
  VesselGraph nothing;
  nothing.points = {{0, 0, 0}};
  nothing.edges = {{0, 0, 1, 1}, {0, 7, 1, 1}};
  EXPECT_THROW(repaired(nothing), InvalidInput);
}

TEST(GraphRepair, Cancels) {
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(repaired(y_graph(), {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::geometry
