#include "ostia/analysis/graph_orders.h"

#include "graph_trees.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace ostia;
using namespace ostia::analysis;
using namespace ostia::analysis::testing;

struct Measured {
  TreeLinks links;
  std::vector<BranchMeasure> branches;
  explicit Measured(const VesselGraph& graph)
      : links(link_tree(graph, geometry::GraphIncidence(graph))), branches(measure_branches(graph, links)) {}
  std::int32_t order_at(const std::vector<std::int32_t>& orders, std::int32_t edge) const {
    return orders[static_cast<std::size_t>(links.branch_of[static_cast<std::size_t>(edge)])];
  }
};

/// A stem along x of `n` edges, radius r, with a side branch of radius s at each of its inner points.
VesselGraph comb(int n, double r, double s) {
  VesselGraph graph;
  for (int i = 0; i <= n; ++i) graph.points.emplace_back(i, 0.0, 0.0);
  for (int i = 0; i < n; ++i) graph.edges.push_back({i, i + 1, r, r});
  for (int i = 1; i < n; ++i) {
    graph.points.emplace_back(i, 0.5, 0.0);
    graph.edges.push_back({i, static_cast<std::int32_t>(graph.points.size()) - 1, s, s});
  }
  return graph;
}

TEST(GraphOrders, StrahlerOfABinaryTreeIsItsLevel) {
  const VesselGraph graph = binary_tree(7);
  const Measured tree(graph);
  const std::vector<std::int32_t> orders = strahler_orders(tree.links);
  EXPECT_EQ(tree.order_at(orders, 0), 7);
  EXPECT_EQ(std::count(orders.begin(), orders.end(), 1), 64);
  EXPECT_EQ(std::count(orders.begin(), orders.end(), 4), 8);
}

TEST(GraphOrders, StrahlerOfACombIsTwo) {
  const VesselGraph graph = comb(20, 1.0, 0.1);
  const Measured tree(graph);
  const std::vector<std::int32_t> orders = strahler_orders(tree.links);
  for (std::int32_t e = 0; e < 19; ++e) EXPECT_EQ(tree.order_at(orders, e), 2) << e;
  EXPECT_EQ(tree.order_at(orders, 19), 1);  // the last piece of the stem has nothing behind it
  EXPECT_EQ(tree.order_at(orders, 25), 1);
}

TEST(GraphOrders, StrahlerOfAForkOfThree) {
  const VesselGraph graph = graph_of({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 0, 0}, {2, -1, 0}},
                                     {{0, 1, 1, 1}, {1, 2, 1, 1}, {1, 3, 1, 1}, {1, 4, 1, 1}});
  const Measured tree(graph);
  EXPECT_EQ(tree.order_at(strahler_orders(tree.links), 0), 2);
}

TEST(GraphOrders, DiametersDecideWhereTheTopologyDoesNot) {
  // The last piece of a wide stem has Strahler's order 1, but the stem's diameter.
  const VesselGraph graph = comb(20, 1.0, 0.1);
  const Measured tree(graph);
  const DiameterOrders orders = diameter_orders(tree.links, tree.branches);
  EXPECT_TRUE(orders.converged);
  for (std::int32_t e = 0; e < 20; ++e) EXPECT_EQ(tree.order_at(orders.of_branch, e), 2) << e;
  for (std::int32_t e = 20; e < 39; ++e) EXPECT_EQ(tree.order_at(orders.of_branch, e), 1) << e;
  // Without spread the bound lies half way.
  ASSERT_EQ(orders.upper_mm.size(), 2U);
  EXPECT_NEAR(orders.upper_mm[0], 0.5 * (0.2 + 2.0), 1e-12);
  EXPECT_TRUE(std::isinf(orders.upper_mm[1]));
}

TEST(GraphOrders, ASecondRoundOfDiametersAgreesWithItself) {
  const VesselGraph graph = binary_tree(9, 0.45, 0.6);
  const Measured tree(graph);
  const DiameterOrders orders = diameter_orders(tree.links, tree.branches);
  EXPECT_TRUE(orders.converged);
  EXPECT_EQ(orders.of_branch, strahler_orders(tree.links));
  for (std::size_t b = 0; b < orders.of_branch.size(); ++b) {
    const auto order = static_cast<std::size_t>(orders.of_branch[b]);
    EXPECT_LE(tree.branches[b].diameter_mm, orders.upper_mm[order - 1]);
    if (order > 1) {
      EXPECT_GT(tree.branches[b].diameter_mm, orders.upper_mm[order - 2]);
    }
  }
  EXPECT_THROW(diameter_orders(tree.links, tree.branches, 0), InvalidInput);
}

TEST(GraphOrders, FollowBoundsThatAreGiven) {
  const VesselGraph graph = binary_tree(4, 0.45, 0.5);  // diameters 2, 1, 0.5, 0.25
  const Measured tree(graph);
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::int32_t> orders =
      orders_by_bounds(tree.links, tree.branches, {0.3, 0.4, 1.5, infinity});
  EXPECT_EQ(tree.order_at(orders, 0), 4);
  EXPECT_EQ(tree.order_at(orders, 1), 3);
  EXPECT_EQ(tree.order_at(orders, 3), 3);
  EXPECT_EQ(tree.order_at(orders, 14), 1);
  EXPECT_THROW(orders_by_bounds(tree.links, tree.branches, {2.0, 1.0, infinity}), InvalidInput);
  EXPECT_THROW(orders_by_bounds(tree.links, tree.branches, {1.0}), InvalidInput);
}

TEST(GraphOrders, NoOrderRisesAwayFromTheRoot) {
  VesselGraph graph = binary_tree(6, 0.45, 0.7);
  graph.edges[40].radius_from = graph.edges[40].radius_to = 3.0;  // an aneurysm far out
  const Measured tree(graph);
  const DiameterOrders orders = diameter_orders(tree.links, tree.branches);
  for (std::size_t b = 0; b < orders.of_branch.size(); ++b) {
    const std::int32_t parent = tree.links.branch_parent[b];
    if (parent < 0) continue;
    EXPECT_GE(orders.of_branch[static_cast<std::size_t>(parent)], orders.of_branch[b]);
  }
}

TEST(GraphOrders, ElementsRunInSeriesAndTheirMatrixCountsWhatSprings) {
  const VesselGraph graph = comb(20, 1.0, 0.1);
  const Measured tree(graph);
  const std::vector<std::int32_t> orders = diameter_orders(tree.links, tree.branches).of_branch;
  const TreeElements elements = tree_elements(tree.links, tree.branches, orders);
  ASSERT_EQ(elements.elements.size(), 20U);
  EXPECT_EQ(elements.elements[0].order, 2);
  EXPECT_EQ(elements.elements[0].branches, 20);
  EXPECT_NEAR(elements.elements[0].length_mm, 20.0, 1e-12);
  EXPECT_NEAR(elements.elements[0].diameter_mm, 2.0, 1e-12);
  const ConnectivityMatrix matrix = connectivity_matrix(elements);
  ASSERT_EQ(matrix.orders, 2);
  EXPECT_EQ(matrix.at(1, 2), 19.0);
  EXPECT_EQ(matrix.at(2, 2), 0.0);
  EXPECT_EQ(matrix.at(2, 1), 0.0);
  EXPECT_EQ(matrix.elements[0], 19);
  const std::vector<OrderMeasure> rows = measure_orders(elements, tree.branches);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].branches_per_element.mean, 20.0);
  EXPECT_NEAR(rows[0].element_length_mm.mean, 0.5, 1e-12);
  EXPECT_EQ(rows[0].element_length_mm.sd(), 0.0);
}

TEST(GraphOrders, TheWiderOfTwoOfTheSameOrderContinues) {
  // Both children are of the parent's order by diameter: the wider goes on, the other springs from it.
  const VesselGraph graph = graph_of({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, -1, 0}},
                                     {{0, 1, 1.0, 1.0}, {1, 2, 0.8, 0.8}, {1, 3, 0.9, 0.9}});
  const Measured tree(graph);
  const TreeElements elements = tree_elements(tree.links, tree.branches, {3, 3, 3});
  ASSERT_EQ(elements.elements.size(), 2U);
  EXPECT_EQ(tree.order_at(elements.of_branch, 2), tree.order_at(elements.of_branch, 0));
  EXPECT_EQ(connectivity_matrix(elements).at(3, 3), 0.5);
}

TEST(GraphOrders, MeansAndDeviations) {
  RunningMean mean;
  for (const double v : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) mean.add(v);
  EXPECT_NEAR(mean.mean, 5.0, 1e-12);
  EXPECT_NEAR(mean.sd(), std::sqrt(32.0 / 7.0), 1e-12);
}

}  // namespace
