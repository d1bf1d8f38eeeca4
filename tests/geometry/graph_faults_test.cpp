#include "ostia/geometry/graph_faults.h"

#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_units.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::geometry {
namespace {

using Kind = GraphFaultKind;
constexpr double nan_graph_faults = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

const GraphFault& fault(const GraphFaults& faults, Kind kind) {
  static const GraphFault none;
  for (const GraphFault& f : faults.found)
    if (f.kind == kind) return f;
  ADD_FAILURE() << "no " << name_of(kind);
  return none;
}

using Indices = std::vector<std::int32_t>;

TEST(GraphFaults, ASoundTreeHasNone) {
  const GraphFaults faults = find_faults(y_graph());
  EXPECT_TRUE(faults.found.empty()) << summary(faults, y_graph());
  EXPECT_TRUE(faults.sound_tree());
  EXPECT_EQ(summary(faults, y_graph()), "none");
  EXPECT_NO_THROW(require_sound(y_graph(), "it", true));
}

TEST(GraphFaults, RadiiAreCountedByKind) {
  VesselGraph graph = y_graph();
  graph.edges[0].radius_from = nan_graph_faults;
  graph.edges[1].radius_to = infinite;
  graph.edges[2].radius_to = -1.0;
  graph.edges[3].radius_from = graph.edges[3].radius_to = 0.0;
  const GraphFaults faults = find_faults(graph);
  EXPECT_EQ(faults.found.size(), 3u);
  EXPECT_EQ(fault(faults, Kind::missing_radius).edges, (Indices{0, 1}));
  EXPECT_EQ(fault(faults, Kind::negative_radius).edges, (Indices{2}));
  EXPECT_EQ(fault(faults, Kind::zero_radius).count, 1u);
  EXPECT_FALSE(faults.sound());
}

TEST(GraphFaults, PlacesAndLengths) {
  VesselGraph graph = y_graph();
  graph.points.push_back({3, 5, 13});                // 6, at 5's place, and joined to it
  graph.points.push_back({-0.0, 0, 0});              // 7, at 0's place: a loose one
  graph.points.push_back({nan_graph_faults, 0, 0});  // 8
  graph.edges.push_back({5, 6, 0.2, 0.2});
  graph.edges.push_back({3, 3, 1.0, 1.0});
  graph.edges.push_back({3, 8, 1.0, 1.0});
  const GraphFaults faults = find_faults(graph);
  EXPECT_EQ(fault(faults, Kind::duplicate_point).points, (Indices{6, 7}));
  EXPECT_EQ(fault(faults, Kind::non_finite_point).points, (Indices{8}));
  EXPECT_EQ(fault(faults, Kind::zero_length).edges, (Indices{5, 6}));
  EXPECT_EQ(fault(faults, Kind::loose_point).points, (Indices{7}));
}

TEST(GraphFaults, IndicesOutOfRangeAreNoCrash) {
  VesselGraph graph = y_graph();
  graph.edges.push_back({-1, 2, 1.0, 1.0});
  graph.edges.push_back({2, 6, 1.0, 1.0});
  graph.references.insert(graph.references.end(), {16, 17});
  const GraphFaults faults = find_faults(graph);
  ASSERT_EQ(faults.found.size(), 1u);
  EXPECT_EQ(text_of(faults.found[0], graph, "line"),
            "2 segments name points that are not there (line 16, line 17)");
  EXPECT_EQ(facts_of(graph).parts, 1u);
}

TEST(GraphFaults, LoopsParentsRootsAndParts) {
  VesselGraph graph = y_graph();
  graph.edges.push_back({3, 5, 1.0, 1.0});  // a loop, and 5 has two parents
  graph.points.insert(graph.points.end(), {{9, 0, 0}, {9, 1, 0}, {9, 2, 0}});
  graph.edges.push_back({6, 7, 1.0, 1.0});  // another part with two roots
  graph.edges.push_back({8, 7, 1.0, 1.0});
  const GraphFaults faults = find_faults(graph);
  EXPECT_TRUE(faults.sound()) << "a network may have all of that";
  EXPECT_FALSE(faults.sound_trees());
  EXPECT_EQ(fault(faults, Kind::cycle).edges, (Indices{5}));
  EXPECT_EQ(fault(faults, Kind::several_parents).points, (Indices{5, 7}));
  EXPECT_EQ(fault(faults, Kind::several_roots).points, (Indices{8}));
  EXPECT_EQ(fault(faults, Kind::several_parts).points, (Indices{6}));
  EXPECT_THROW(require_sound(graph, "it", true), InvalidInput);
}

TEST(GraphFaults, ACircleHasNoRoot) {
  VesselGraph graph;
  graph.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  graph.edges = {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 0, 1, 1}};
  const GraphFaults faults = find_faults(graph);
  EXPECT_EQ(fault(faults, Kind::no_root).count, 1u);
  EXPECT_EQ(fault(faults, Kind::cycle).edges, (Indices{2}));
}

TEST(GraphFaults, SegmentsThatAreThereTwiceInEitherDirection) {
  VesselGraph graph = y_graph();
  graph.edges.push_back({0, 1, 9.0, 9.0});
  graph.edges.push_back({4, 2, 9.0, 9.0});
  EXPECT_EQ(fault(find_faults(graph), Kind::duplicate_segment).edges, (Indices{5, 6}));
}

TEST(GraphFaults, OfManyPlacesTheFirstAreKept) {
  VesselGraph graph = y_graph();
  graph.references.clear();
  for (int i = 0; i < 20; ++i) graph.edges.push_back({1, 1, 1.0, 1.0});
  const GraphFaults faults = find_faults(graph);
  EXPECT_EQ(fault(faults, Kind::zero_length).count, 20u);
  EXPECT_EQ(text_of(fault(faults, Kind::zero_length), graph),
            "20 segments have no length (segment 5, segment 6, segment 7, segment 8, segment 9, ...)");
}

TEST(GraphFaults, ARequirementNamesItsFaultsAndTheWayOut) {
  VesselGraph graph = y_graph();
  graph.edges[0].radius_to = 0.0;
  try {
    require_sound(graph, "tree.swc", false);
    ADD_FAILURE() << "accepted";
  } catch (const InvalidInput& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("tree.swc"), std::string::npos) << said;
    EXPECT_NE(said.find("1 segment has the radius zero (segment 11)"), std::string::npos) << said;
    EXPECT_NE(said.find("--repair"), std::string::npos) << said;
  }
  EXPECT_THROW(require_sound({}, "nothing", false), InvalidInput);
}

TEST(GraphFaults, Cancels) {
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(find_faults(y_graph(), task), Cancelled);
  EXPECT_THROW(facts_of(y_graph(), task), Cancelled);
}

TEST(GraphFacts, OfAFork) {
  const GraphFacts facts = facts_of(y_graph());
  EXPECT_EQ(facts.points, 6u);
  EXPECT_EQ(facts.segments, 5u);
  EXPECT_EQ(facts.branches, 3u);
  EXPECT_EQ(facts.parts, 1u);
  EXPECT_EQ(facts.roots, 1u);
  EXPECT_EQ(facts.ends, 2u);
  EXPECT_EQ(facts.forks, 1u);
  EXPECT_EQ(facts.trifurcations, 0u);
  EXPECT_EQ(facts.loops, 0u);
  EXPECT_DOUBLE_EQ(facts.length_mm, 5.0 + 12.0 + 2.0 + 1.0 + 1.0);
  EXPECT_EQ(facts.least_radius_mm, 0.25);
  EXPECT_EQ(facts.largest_radius_mm, 2.0);
  EXPECT_EQ(facts.box.max(), Vec3(3, 5, 14));
}

// Branches are counted without being made; the two must agree, circles and all.
TEST(GraphFacts, BranchesAgreeWithTheirList) {
  VesselGraph graph = y_graph();
  graph.points.insert(graph.points.end(), {{9, 0, 0}, {9, 1, 0}, {8, 0, 0}});
  for (const auto& [a, b] : std::vector<std::pair<int, int>>{{6, 7}, {7, 6}, {8, 8}, {2, 5}, {2, 0}})
    graph.edges.push_back({a, b, 1.0, 1.0});
  const GraphFacts facts = facts_of(graph);
  EXPECT_EQ(facts.branches, branches(graph, GraphIncidence(graph)).size());
  EXPECT_EQ(facts.trifurcations, 1u);
  EXPECT_EQ(facts.joins, 1u);
  EXPECT_EQ(facts.loops, 4u);
}

TEST(GraphUnits, BranchesShorterThanTheLeastRadiusAreDoubted) {
  GraphFacts facts = facts_of(y_graph());
  EXPECT_EQ(unit_doubt(facts), "");
  facts.length_mm = 0.99 * facts.least_radius_mm * static_cast<double>(facts.branches);
  EXPECT_NE(unit_doubt(facts).find("different units"), std::string::npos);
}

}  // namespace
}  // namespace ostia::geometry
