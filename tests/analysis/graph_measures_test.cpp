#include "ostia/analysis/graph_measures.h"

#include "graph_trees.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace {

using namespace ostia;
using namespace ostia::analysis;
using namespace ostia::analysis::testing;
using std::numbers::pi;

TreeLinks links_of(const VesselGraph& graph) {
  return link_tree(graph, geometry::GraphIncidence(graph));
}

std::string refusal(const VesselGraph& graph) {
  try {
    links_of(graph);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(GraphMeasures, KnowsCylinderConeAndFrustum) {
  const ConeMeasure cylinder = measure_cone(5.0, 2.0, 2.0);
  EXPECT_NEAR(cylinder.area_mm2, 20.0 * pi, 1e-12);
  EXPECT_NEAR(cylinder.volume_mm3, 20.0 * pi, 1e-12);
  const ConeMeasure cone = measure_cone(4.0, 3.0, 0.0);
  EXPECT_NEAR(cone.area_mm2, pi * 3.0 * 5.0, 1e-12);
  EXPECT_NEAR(cone.volume_mm3, pi * 9.0 * 4.0 / 3.0, 1e-12);
  const ConeMeasure frustum = measure_cone(4.0, 6.0, 3.0);
  EXPECT_NEAR(frustum.area_mm2, pi * 9.0 * 5.0, 1e-12);
  EXPECT_NEAR(frustum.volume_mm3, pi * 8.0 * 36.0 / 3.0 - pi * 4.0 * 9.0 / 3.0, 1e-12);
}

TEST(GraphMeasures, SumsSubtreesOfABinaryTree) {
  const VesselGraph graph = binary_tree(6, 0.45, 0.7);
  const TreeLinks links = links_of(graph);
  const std::vector<SubtreeTotals> totals = subtree_totals(graph, links);
  double length = 0.0, area = 0.0, volume = 0.0;
  for (int level = 0; level < 6; ++level) {
    const double n = std::pow(2.0, level), l = std::pow(0.45, level), r = std::pow(0.7, level);
    length += n * l;
    area += n * 2.0 * pi * r * l;
    volume += n * pi * r * r * l;
  }
  EXPECT_NEAR(totals[0].length_mm, length, 1e-12 * length);
  EXPECT_NEAR(totals[0].area_mm2, area, 1e-12 * area);
  EXPECT_NEAR(totals[0].volume_mm3, volume, 1e-12 * volume);
  EXPECT_EQ(totals[0].segments, 63);
  EXPECT_EQ(totals[0].ends, 32);
  EXPECT_EQ(totals[62].segments, 1);
  EXPECT_EQ(totals[62].ends, 1);
}

TEST(GraphMeasures, DoesNotDependOnTheOrderOfTheSegments) {
  VesselGraph graph = binary_tree(5);
  const SubtreeTotals before = subtree_totals(graph, links_of(graph))[0];
  std::reverse(graph.edges.begin(), graph.edges.end());
  const SubtreeTotals after = subtree_totals(graph, links_of(graph)).back();
  EXPECT_NEAR(before.volume_mm3, after.volume_mm3, 1e-12);
  EXPECT_EQ(before.ends, after.ends);
}

TEST(GraphMeasures, MeasuresABranchOverItsSegments) {
  // A right angle: 3 mm of diameter 2, then 4 mm of diameter 4 to 2.
  const VesselGraph graph = graph_of({{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, {{0, 1, 1.0, 1.0}, {1, 2, 2.0, 1.0}});
  const TreeLinks links = links_of(graph);
  ASSERT_EQ(links.branches.size(), 1U);
  const BranchMeasure branch = measure_branches(graph, links)[0];
  EXPECT_NEAR(branch.sum.length_mm, 7.0, 1e-12);
  EXPECT_NEAR(branch.chord_mm, 5.0, 1e-12);
  EXPECT_NEAR(branch.diameter_mm, (3.0 * 2.0 + 4.0 * 3.0) / 7.0, 1e-12);
  EXPECT_EQ(branch.radius_to_mm, 1.0);
}

TEST(GraphMeasures, MeasuresAlongTheTree) {
  // A fork at (0,0,2) with ends at 3 and 4 mm from it, and a second tree.
  const VesselGraph graph = graph_of({{0, 0, 0}, {0, 0, 2}, {3, 0, 2}, {-4, 0, 2}, {50, 0, 0}, {51, 0, 0}},
                                     {{0, 1, 1, 1}, {1, 2, 1, 1}, {1, 3, 1, 1}, {4, 5, 1, 1}});
  const TreeDistances distances(graph, links_of(graph));
  EXPECT_NEAR(distances.between_mm(2, 3).value(), 7.0, 1e-12);
  EXPECT_NEAR(distances.between_mm(0, 3).value(), 6.0, 1e-12);
  EXPECT_NEAR(distances.between_mm(3, 0).value(), 6.0, 1e-12);
  EXPECT_EQ(distances.between_mm(2, 2).value(), 0.0);
  EXPECT_FALSE(distances.between_mm(2, 5).has_value());
  EXPECT_THROW(distances.between_mm(0, 6), InvalidInput);
}

TEST(GraphMeasures, TakesATreeAMillionDeep) {
  const VesselGraph graph = line_of(1'000'000);
  const TreeLinks links = links_of(graph);
  EXPECT_NEAR(subtree_totals(graph, links)[0].length_mm, 1e6, 1e-3);
  EXPECT_NEAR(TreeDistances(graph, links).between_mm(1'000'000, 0).value(), 1e6, 1e-3);
}

TEST(GraphMeasures, RefusesWhatIsNoTree) {
  VesselGraph joins = graph_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 2, 1, 1}, {1, 2, 1, 1}});
  joins.references = {700, 800};
  EXPECT_NE(refusal(joins).find("segment 1 (800 in its file) joins segment 0 (700 in its file) at point 2"),
            std::string::npos)
      << refusal(joins);
  const VesselGraph loop =
      graph_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 0, 1, 1}});
  EXPECT_NE(refusal(loop).find("loop"), std::string::npos);
  VesselGraph bad = line_of(3);
  bad.edges[1].radius_to = -0.5;
  EXPECT_NE(refusal(bad).find("segment 1 has the radius -0.5"), std::string::npos);
  bad.edges[1].radius_to = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(bad).find("segment 1 has the radius nan"), std::string::npos);
  bad = line_of(3);
  bad.points[3].x() = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(bad).find("point 3"), std::string::npos);
  EXPECT_NE(refusal(VesselGraph{}).find("without segments"), std::string::npos);
}

TEST(GraphMeasures, IsCancelled) {
  const VesselGraph graph = line_of(3);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(link_tree(graph, geometry::GraphIncidence(graph), task), Cancelled);
}

}  // namespace
