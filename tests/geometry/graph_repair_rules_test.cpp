// Which of two survives, what a radius is taken from, and which way segments run where lengths decide
// nothing.

#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_repair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

constexpr double nan_graph_repair_rules = std::numeric_limits<double>::quiet_NaN();

std::size_t step(const RepairedGraph& fixed, const std::string& what) {
  for (const GraphRepairStep& s : fixed.steps)
    if (s.what == what) return s.count;
  return 0;
}

TEST(GraphRepairRules, OfSegmentsThatAreThereTwiceTheFirstStays) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {0, 0, 5}};
  graph.edges = {{0, 1, 2.0, 1.5}, {1, 0, 9.0, 8.0}, {0, 1, 7.0, 7.0}};
  graph.references = {40, 41, 42};
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(step(fixed, "duplicate_dropped"), 2u);
  EXPECT_EQ(step(fixed, "radii_filled"), 0u);
  ASSERT_EQ(fixed.graph.edges.size(), 1u);
  EXPECT_EQ(fixed.graph.points[0], Vec3(0, 0, 0));
  EXPECT_EQ(fixed.graph.edges[0].radius_from, 2.0);
  EXPECT_EQ(fixed.graph.edges[0].radius_to, 1.5);
  EXPECT_EQ(fixed.graph.references, (std::vector<std::int64_t>{40}));
}

// What the first one lacks, the next one that has it gives, end for end.
TEST(GraphRepairRules, ASegmentTakesTheRadiiOfItsTwins) {
  VesselGraph graph = y_graph();
  graph.edges[1].radius_to =
      nan_graph_repair_rules;               // 1 to 2; without twins: the mean of what leaves point 2
  graph.edges.push_back({2, 1, 0.0, 9.0});  // has none at 2, either
  graph.edges.push_back({2, 1, 1.4, 9.0});
  graph.edges.push_back({1, 2, 9.0, 1.3});
  graph.references.insert(graph.references.end(), {16, 17, 18});
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(step(fixed, "radii_filled"), 1u);
  EXPECT_EQ(fixed.graph.edges[1].radius_from, 1.75);
  EXPECT_EQ(fixed.graph.edges[1].radius_to, 1.4);
}

// A vessel without length has a radius that stands for nothing where others are known.
TEST(GraphRepairRules, DroppedSegmentsCountOnlyWhereNothingElseIsKnown) {
  VesselGraph graph = y_graph();
  graph.edges[2].radius_from = nan_graph_repair_rules;  // at the fork 1.5 arrives and 0.75 leaves
  graph.edges.push_back({2, 2, 9.0, 9.0});
  graph.edges.push_back({3, 3, nan_graph_repair_rules, nan_graph_repair_rules});
  graph.references.insert(graph.references.end(), {16, 17});
  const RepairedGraph fixed = repaired(graph);
  EXPECT_DOUBLE_EQ(fixed.graph.edges[2].radius_from, 1.125);
  EXPECT_EQ(step(fixed, "radii_filled"), 1u) << "what is dropped is not filled";
  EXPECT_EQ(step(fixed, "zero_length_dropped"), 2u);
}

TEST(GraphRepairRules, ZeroAndMinusZeroAreOnePlaceAndTheFirstStays) {
  for (const double first : {0.0, -0.0}) {
    VesselGraph graph;
    graph.points = {{first, 0, 0}, {1, 0, 0}, {-first, 0, 0}, {0, 1, -0.0}, {0, 1, 0.0}, {0, 2, 0}};
    graph.edges = {{0, 1, 1, 1}, {2, 3, 1, 1}, {4, 5, 1, 1}, {2, 1, 1, 1}};
    const RepairedGraph fixed = repaired(graph);
    EXPECT_EQ(step(fixed, "points_joined"), 2u);
    EXPECT_EQ(step(fixed, "duplicate_dropped"), 1u);
    EXPECT_TRUE(fixed.left.sound_tree()) << summary(fixed.left, fixed.graph);
    ASSERT_EQ(fixed.graph.points.size(), 4u);
    for (const Vec3& p : fixed.graph.points) {
      if (p == Vec3(0, 0, 0)) {
        EXPECT_EQ(std::signbit(p.x()), std::signbit(first));
      }
      if (p == Vec3(0, 1, 0)) {
        EXPECT_TRUE(std::signbit(p.z()));
      }
    }
  }
}

TEST(GraphRepairRules, OfPointsThatAreNearTheFirstKeepsItsPlace) {
  VesselGraph graph;
  graph.points = {{1, 0.004, 0}, {2, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0.008, 0}, {1, 3, 0}};
  graph.edges = {{0, 1, 1, 1}, {2, 3, 2, 1}, {4, 5, 1, 1}};
  GraphRepairOptions near;
  near.merge_within_mm = 0.005;
  const RepairedGraph fixed = repaired(graph, near);
  EXPECT_EQ(step(fixed, "points_joined"), 2u);
  EXPECT_TRUE(fixed.left.sound_tree());
  EXPECT_EQ(fixed.graph.points[1], Vec3(1, 0.004, 0));
}

// So short that the way from the root to its two ends is one number: it is turned all the same.
TEST(GraphRepairRules, TurnsSegmentsThatAreLostInTheLengthBeforeThem) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {1e6, 0, 0}, {1e6, 1e-12, 0}, {1e6, 2e-12, 0}};
  graph.edges = {{0, 1, 2, 2}, {2, 1, 1, 1}, {3, 2, 1, 1}};
  const RepairedGraph fixed = repaired(graph);
  EXPECT_EQ(step(fixed, "turned"), 2u);
  EXPECT_TRUE(fixed.left.sound_tree()) << summary(fixed.left, fixed.graph);
}

// Three places as far from the root as one another, with vessels round in a circle between them.
TEST(GraphRepairRules, NothingRunsInACircleOnceItIsTurned) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  graph.edges = {{0, 1, 1, 1}, {0, 2, 1, 1}, {0, 3, 1, 1}, {1, 2, 1, 1}, {2, 3, 1, 1}, {3, 1, 1, 1}};
  GraphRepairOptions options;
  options.roots = {Vec3(0, 0, 0)};
  const RepairedGraph fixed = repaired(graph, options);
  EXPECT_EQ(fixed.graph.edges.size(), 6u);
  for (const GraphEdge& edge : fixed.graph.edges) EXPECT_LT(edge.from, edge.to);
}

TEST(GraphRepairRules, PlacesAreNamedByTheLineOfOneOfTheirSegments) {
  VesselGraph graph = y_graph();
  graph.points[5] = graph.points[3];
  graph.points.push_back({nan_graph_repair_rules, 0, 0});
  graph.edges.push_back({6, 0, 1, 1});
  graph.references.push_back(16);
  graph.points.push_back({nan_graph_repair_rules, 0, 0});
  const std::string said = summary(find_faults(graph), graph, "line");
  EXPECT_NE(said.find("2 points have coordinates that are no finite numbers (point 6 of line 16, point 7)"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("1 point is at the place of another (point 5 of line 15)"), std::string::npos) << said;
  graph.references.clear();
  EXPECT_NE(summary(find_faults(graph), graph).find("(point 5)"), std::string::npos);
}

TEST(GraphRepairRules, ARequirementSpeaksOfTheFilesOwnLines) {
  VesselGraph graph = y_graph();
  graph.edges[0].radius_to = 0.0;
  try {
    require_sound(graph, "tree.swc", false, core::no_task(), "line");
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("(line 11)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace ostia::geometry
