#include "ostia/analysis/tree_growth.h"

#include "graph_trees.h"
#include "growth_stubs.h"
#include "published_sizes.h"

#include "ostia/analysis/graph_overlaps.h"
#include "ostia/analysis/graph_report.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace {

using namespace ostia;
using namespace ostia::analysis;
using namespace ostia::analysis::testing;

TEST(GrowthDomain, KnowsTheDepthInAShell) {
  MyocardialShell sphere;
  sphere.radius_mm = sphere.length_mm = 40.0;
  sphere.wall_mm = 10.0;
  sphere.whole = true;
  const GrowthDomain depth = domain_of(sphere);
  EXPECT_NEAR(depth({39.0, 0, 0}), 1.0, 0.02);
  EXPECT_NEAR(depth({0, 0, -31.0}), 1.0, 0.02);
  EXPECT_NEAR(depth({0, 41.0, 0}), -1.0, 0.03);
  EXPECT_LT(depth({0, 0, 0}), 0.0);
  const GrowthDomain half = domain_of(MyocardialShell{});
  EXPECT_GT(half({34.0, 0, 5.0}), 0.0);
  EXPECT_LT(half({34.0, 0, -0.1}), 0.0);
  EXPECT_LT(half({0, 0, 40.0}), 0.0);
  EXPECT_GT(half({0, 0, 84.0}), 0.0);
  sphere.wall_mm = 50.0;
  EXPECT_THROW(domain_of(sphere), InvalidInput);
}

TEST(GrowthDomain, FindsTheSphereTheTreeLiesOn) {
  VesselGraph graph;
  for (int i = 0; i < 50; ++i)
    graph.points.push_back(Vec3(5, 6, 7) +
                           40.0 * Vec3(std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i + 1)).normalized());
  const MyocardialShell shell = shell_about(graph);
  EXPECT_NEAR((shell.base - Vec3(5, 6, 7)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(shell.radius_mm, 40.0, 1e-9);
  EXPECT_THROW(shell_about(line_of(20)), InvalidInput);
  EXPECT_THROW(shell_about(VesselGraph{}), InvalidInput);
}

TEST(GrowthDomain, IsTheInsideOfASurface) {
  // A cube of 10 mm; corner i has x, y, z in its bits.
  geometry::TriMesh cube;
  for (int i = 0; i < 8; ++i) cube.points.emplace_back(10.0 * (i & 1), 5.0 * (i & 2), 2.5 * (i & 4));
  for (const std::array<std::int32_t, 4>& side : {std::array<std::int32_t, 4>{0, 2, 3, 1},
                                                  {4, 5, 7, 6},
                                                  {0, 1, 5, 4},
                                                  {2, 6, 7, 3},
                                                  {0, 4, 6, 2},
                                                  {1, 3, 7, 5}}) {
    cube.triangles.push_back({side[0], side[1], side[2]});
    cube.triangles.push_back({side[0], side[2], side[3]});
  }
  const GrowthDomain depth = domain_of(cube);
  EXPECT_NEAR(depth({5, 5, 2}), 2.0, 1e-9);
  EXPECT_NEAR(depth({5, 5, 13}), -3.0, 1e-9);
  EXPECT_THROW(domain_of(geometry::TriMesh{}), InvalidInput);
}

class GrownTreeTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scanned_ = new VesselGraph(stubs(6, 0.231));
    tree_ = new GrownTree(grow_tree(*scanned_, domain_of(MyocardialShell{})));
  }
  static void TearDownTestSuite() {
    delete tree_;
    delete scanned_;
  }
  static VesselGraph* scanned_;
  static GrownTree* tree_;
};
VesselGraph* GrownTreeTest::scanned_ = nullptr;
GrownTree* GrownTreeTest::tree_ = nullptr;

TEST_F(GrownTreeTest, KeepsWhatWasScanned) {
  ASSERT_GT(tree_->graph.edges.size(), 40'000U);
  for (std::size_t e = 0; e < scanned_->edges.size(); ++e) {
    EXPECT_EQ(tree_->graph.edges[e].from, scanned_->edges[e].from);
    EXPECT_EQ(tree_->graph.edges[e].radius_to, scanned_->edges[e].radius_to);
    EXPECT_EQ(tree_->order[e], 0);
  }
  for (std::size_t p = 0; p < scanned_->points.size(); ++p)
    EXPECT_EQ(tree_->graph.points[p], scanned_->points[p]);
}

TEST_F(GrownTreeTest, NothingRunsIntoAnything) {
  EXPECT_TRUE(find_overlaps(tree_->graph, geometry::GraphIncidence(tree_->graph)).empty());
  EXPECT_LT(tree_->elements_left_out, tree_->elements / 100);
  EXPECT_LT(tree_->elements_shortened, tree_->elements / 100);
}

double distance(const Vec3& place, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double t = std::clamp((place - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (place - from - t * along).norm();
}

// A fine vessel that leaves a wide one is longer than the wide one's radius, whatever the table's mean is.
TEST_F(GrownTreeTest, NoVesselEndsWithinTheOneItSpringsFrom) {
  const VesselGraph& graph = tree_->graph;
  std::vector<std::int32_t> arriving(graph.points.size(), -1);
  std::vector<std::vector<std::int32_t>> segments(static_cast<std::size_t>(tree_->elements));
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    arriving[static_cast<std::size_t>(graph.edges[e].to)] = static_cast<std::int32_t>(e);
    if (tree_->element[e] >= 0)
      segments[static_cast<std::size_t>(tree_->element[e])].push_back(static_cast<std::int32_t>(e));
  }
  std::size_t daughters = 0, inside = 0;
  for (const std::vector<std::int32_t>& own : segments) {
    if (own.empty()) continue;
    const auto edge = [&](std::int32_t e) { return graph.edges[static_cast<std::size_t>(e)]; };
    const std::int32_t stem =
        tree_->element[static_cast<std::size_t>(arriving[static_cast<std::size_t>(edge(own[0]).from)])];
    if (stem < 0) continue;
    ++daughters;
    const Vec3 end = graph.points[static_cast<std::size_t>(edge(own.back()).to)];
    for (const std::int32_t s : segments[static_cast<std::size_t>(stem)])
      if (distance(end, graph.points[static_cast<std::size_t>(edge(s).from)],
                   graph.points[static_cast<std::size_t>(edge(s).to)]) < edge(s).radius_to) {
        ++inside;
        break;
      }
  }
  EXPECT_GT(daughters, 20'000U);
  EXPECT_EQ(inside, 0U);
}

TEST_F(GrownTreeTest, LiesInTheWall) {
  const GrowthDomain depth = domain_of(MyocardialShell{});
  std::size_t outside = 0;
  for (std::size_t e = scanned_->edges.size(); e < tree_->graph.edges.size(); ++e)
    outside += depth(tree_->graph.points[static_cast<std::size_t>(tree_->graph.edges[e].to)]) < 0.0 ? 1U : 0U;
  EXPECT_EQ(outside, 0U);
}

TEST_F(GrownTreeTest, HasThePublishedSizesAndConnectivity) {
  expect_published_sizes(*tree_);
}

TEST(TreeGrowth, IsThatOfItsSeed) {
  const VesselGraph scanned = stubs(2, 0.1);
  GrowthOptions options;
  const auto grow = [&] { return grow_tree(scanned, domain_of(MyocardialShell{}), options); };
  const GrownTree a = grow(), b = grow();
  options.seed = 2;
  const GrownTree c = grow();
  ASSERT_EQ(a.graph.points.size(), b.graph.points.size());
  for (std::size_t p = 0; p < a.graph.points.size(); ++p) ASSERT_EQ(a.graph.points[p], b.graph.points[p]);
  EXPECT_NE(a.graph.points.back(), c.graph.points.back());
}

TEST(TreeGrowth, RefusesWhatItCannotGrowFromAndIsCancelled) {
  const GrowthDomain domain = domain_of(MyocardialShell{});
  EXPECT_THROW(grow_tree(VesselGraph{}, domain), InvalidInput);
  VesselGraph bad = stubs(2, 0.1);
  bad.edges[1].radius_to = 0.0;
  EXPECT_THROW(grow_tree(bad, domain), InvalidInput);
  bad = stubs(2, 0.1);
  bad.edges[1].to = 77;
  EXPECT_THROW(grow_tree(bad, domain), InvalidInput);
  bad = stubs(2, 0.1);
  bad.edges[1].to = bad.edges[0].to;
  EXPECT_THROW(grow_tree(bad, domain), InvalidInput);
  GrowthOptions few;
  few.most_segments = 100;
  EXPECT_THROW(grow_tree(stubs(2, 0.1), domain, few), ResourceError);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(grow_tree(stubs(2, 0.1), domain, {}, task), Cancelled);
}

}  // namespace
