#include "ostia/geometry/vessel_graph.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <string>

namespace ostia::geometry {
namespace {

using Indices = std::vector<std::int32_t>;

/// Points on a line, whatever the graph; edges of radius 1.
VesselGraph graph_of(std::size_t points, const std::vector<std::pair<int, int>>& edges) {
  VesselGraph graph;
  for (std::size_t i = 0; i < points; ++i) graph.points.emplace_back(static_cast<double>(i), 0.0, 0.0);
  for (const auto& [from, to] : edges) graph.edges.push_back({from, to, 1.0, 1.0});
  return graph;
}

Indices list(std::span<const std::int32_t> row) {
  return {row.begin(), row.end()};
}

std::vector<Indices> chains(const VesselGraph& graph) {
  std::vector<Indices> out;
  for (const GraphBranch& branch : branches(graph, GraphIncidence(graph))) out.push_back(branch.edges);
  return out;
}

TEST(VesselGraph, IncidenceIsInTheOrderOfTheEdges) {
  const VesselGraph graph = graph_of(5, {{1, 2}, {0, 1}, {1, 3}, {2, 3}, {1, 4}});
  const GraphIncidence incidence(graph);
  EXPECT_EQ(list(incidence.leaving(1)), (Indices{0, 2, 4}));
  EXPECT_EQ(list(incidence.arriving(1)), (Indices{1}));
  EXPECT_EQ(list(incidence.arriving(3)), (Indices{2, 3}));
  EXPECT_TRUE(incidence.leaving(4).empty());
  EXPECT_TRUE(incidence.arriving(0).empty());
}

TEST(VesselGraph, IncidenceRefusesAPointThatIsNotThere) {
  for (const auto& edge : std::vector<std::pair<int, int>>{{0, 3}, {-1, 1}}) {
    try {
      GraphIncidence incidence(graph_of(3, {{0, 1}, edge}));
      ADD_FAILURE() << "accepted";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("segment 1"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("points 0 to 2"), std::string::npos) << error.what();
    }
  }
}

TEST(VesselGraph, NothingHasNoBranches) {
  EXPECT_TRUE(chains({}).empty());
}

// A trunk of two edges, unordered, that forks; one child of three edges, one of one.
TEST(VesselGraph, BranchesOfAFork) {
  EXPECT_EQ(chains(graph_of(7, {{4, 5}, {1, 2}, {2, 3}, {0, 1}, {2, 4}, {5, 6}})),
            (std::vector<Indices>{{2}, {3, 1}, {4, 0, 5}}));
}

// Two roots join at 2, and 2 to 3 is one branch; 3 splits and joins again at 6: a loop.
TEST(VesselGraph, BranchesWithSeveralParentsAndALoop) {
  EXPECT_EQ(chains(graph_of(8, {{0, 2}, {1, 2}, {2, 3}, {3, 4}, {4, 6}, {3, 5}, {5, 6}, {6, 7}})),
            (std::vector<Indices>{{0}, {1}, {2}, {3, 4}, {5, 6}, {7}}));
}

TEST(VesselGraph, ACircleBeginsAtItsLowestPoint) {
  EXPECT_EQ(chains(graph_of(6, {{4, 2}, {5, 0}, {2, 3}, {3, 4}, {0, 5}, {1, 1}})),
            (std::vector<Indices>{{2, 3, 0}, {4, 1}, {5}}));
}

// A chain against its edges' order, and a comb: each edge is of one branch, each inner point within one.
TEST(VesselGraph, EveryEdgeIsOfOneBranch) {
  VesselGraph graph = graph_of(3000, {});
  for (std::int32_t i = 0; i < 999; ++i) graph.edges.push_back({998 - i, 999 - i, 1.0, 1.0});
  for (std::int32_t i = 1000; i < 1999; ++i) {
    graph.edges.push_back({i, i + 1, 1.0, 1.0});
    graph.edges.push_back({i, i + 1000, 1.0, 1.0});
  }
  const GraphIncidence incidence(graph);
  const std::vector<GraphBranch> found = branches(graph, incidence);
  ASSERT_EQ(found.size(), 1u + 2 * 999u);
  EXPECT_EQ(found.front().edges.size(), 999u);  // its first edge is the last of the list's chain
  std::vector<int> times(graph.edges.size(), 0);
  for (std::size_t b = 0; b < found.size(); ++b) {
    const Indices& edges = found[b].edges;
    if (b > 0) {
      EXPECT_LT(found[b - 1].edges[0], edges[0]);
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      ++times[static_cast<std::size_t>(edges[i])];
      if (i > 0) {
        EXPECT_EQ(graph.edges[static_cast<std::size_t>(edges[i - 1])].to,
                  graph.edges[static_cast<std::size_t>(edges[i])].from);
      }
    }
  }
  EXPECT_EQ(times, std::vector<int>(graph.edges.size(), 1));
}

}  // namespace
}  // namespace ostia::geometry
