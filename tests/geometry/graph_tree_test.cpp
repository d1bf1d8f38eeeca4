#include "ostia/geometry/graph_tree.h"

#include "test_graphs.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

TEST(GraphTree, ATreeOfNamedVessels) {
  const VesselTree tree = tree_of(y_graph());
  EXPECT_EQ(find_fault(tree), std::nullopt) << find_fault(tree).value_or("");
  ASSERT_EQ(tree.segments.size(), 3u);
  EXPECT_EQ(tree.nodes.size(), 4u);
  ASSERT_EQ(tree.vessels.size(), 2u);
  EXPECT_EQ(tree.segments[0].axis.radius, (std::vector<double>{2.0, 1.75, 1.5}));
  EXPECT_EQ(tree.segments[0].axis.abscissa, (std::vector<double>{0.0, 5.0, 17.0}));
  EXPECT_EQ(tree.segments[1].axis.radius[0], 1.25) << "a child keeps its own radius at the fork";
  EXPECT_EQ(tree.segments[2].axis.radius, (std::vector<double>{0.75, 0.625, 0.25}));
  EXPECT_EQ(tree.vessels[1].segments, (std::vector<std::int32_t>{0, 2}));
}

TEST(GraphTree, AndBack) {
  const VesselGraph graph = graph_of(tree_of(y_graph()));
  ASSERT_EQ(graph.edges.size(), 5u);
  EXPECT_EQ(graph.points.size(), 6u);
  EXPECT_EQ(graph.references, (std::vector<std::int64_t>{0, 0, 1, 2, 2}));
  const VesselTree again = tree_of(graph);
  const VesselTree once = tree_of(y_graph());
  ASSERT_EQ(again.segments.size(), once.segments.size());
  for (std::size_t s = 0; s < once.segments.size(); ++s) {
    EXPECT_EQ(again.segments[s].axis.points, once.segments[s].axis.points);
    EXPECT_EQ(again.segments[s].axis.radius, once.segments[s].axis.radius);
  }
}

TEST(GraphTree, RefusesWhatIsNoTree) {
  VesselGraph graph = y_graph();
  graph.edges.push_back({3, 5, 1, 1});
  EXPECT_THROW(tree_of(graph), InvalidInput);
  VesselTree tree = tree_of(y_graph());
  tree.segments[1].to = 99;
  EXPECT_THROW(graph_of(tree), InvalidInput);
  tree = tree_of(y_graph());
  tree.segments[1].axis.radius.pop_back();
  EXPECT_THROW(graph_of(tree), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
