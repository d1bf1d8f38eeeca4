#include "support/masks.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace ostia::centerline {
namespace {

using imaging::MaskVolume;
using test::graph_of;
using test::grid_of;
using test::mask_of;

/// A stem that splits into two limbs which join again, and a piece on its own.
MaskVolume loop_and_piece() {
  const std::vector<std::vector<Vec3>> lines{
      {{10, 20, 3}, {10, 20, 14}, {4, 20, 22}, {4, 20, 30}, {10, 20, 38}, {10, 20, 50}},
      {{10, 20, 14}, {18, 20, 22}, {18, 20, 30}, {10, 20, 38}},
      {{26, 8, 5}, {26, 8, 25}}};
  return mask_of(grid_of(32, 32, 54), [&](const Vec3& p) {
    for (const auto& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (test::to_segment(p, line[i], line[i + 1]) <= (i == 0 ? 2.4 : 1.8)) return true;
    return false;
  });
}

const Vec3 inlet(10.0, 20.0, 1.0);

TEST(Oriented, EdgesLeadAwayFromTheInletAndInLoopsToo) {
  const SkeletonGraph graph = pruned(graph_of(loop_and_piece()));
  ASSERT_EQ(loop_count(graph), 1);
  ASSERT_EQ(component_count(graph), 2);
  const OrientedSkeleton flow = oriented(graph, {inlet});
  EXPECT_EQ(find_fault(flow.graph), std::nullopt);
  EXPECT_TRUE(flow.graph.oriented);
  ASSERT_EQ(flow.inlets.size(), 1U);
  ASSERT_EQ(flow.guessed.size(), 1U);
  for (const SkeletonEdge& e : flow.graph.edges) {
    // All lines but the piece's rise from the inlet.
    if (e.points[0].x() < 24.0) {
      EXPECT_LT(e.points.front().z(), e.points.back().z());
    }
  }
  EXPECT_EQ(oriented(graph, {inlet}, {.guess = false}).guessed.size(), 0U);
}

TEST(Oriented, FromTheOtherEndItFlowsBack) {
  const OrientedSkeleton flow =
      oriented(pruned(graph_of(loop_and_piece())), {Vec3(10, 20, 52), Vec3(26, 8, 26)});
  EXPECT_TRUE(flow.guessed.empty());
  for (const SkeletonEdge& e : flow.graph.edges) EXPECT_GT(e.points.front().z(), e.points.back().z());
}

TEST(Oriented, AnInletWithinALineCutsIt) {
  const SkeletonGraph graph = pruned(graph_of(loop_and_piece()));
  const OrientedSkeleton flow = oriented(graph, {Vec3(26.5, 8, 15)}, {.snap_mm = 3.0});
  EXPECT_EQ(flow.graph.edges.size(), graph.edges.size() + 1);
  const SkeletonNode& root = node(flow.graph, flow.inlets[0]);
  EXPECT_EQ(root.kind, SkeletonNodeKind::passage);
  EXPECT_LT((root.position - Vec3(26, 8, 15)).norm(), 1.5);
  for (const SkeletonEdge& e : flow.graph.edges) EXPECT_NE(e.to, root.id);
}

TEST(Oriented, RefusesInletsFarOff) {
  const SkeletonGraph graph = pruned(graph_of(loop_and_piece()));
  EXPECT_THROW(oriented(graph, {Vec3(200, 0, 0)}), InvalidInput);
  EXPECT_THROW(oriented(SkeletonGraph{}, {inlet}), InvalidInput);
  EXPECT_THROW(oriented(graph, {inlet}, {.snap_mm = 0.0}), InvalidInput);
}

TEST(VesselTree, LoopsAreOpenedAndAllOfTheLengthIsKept) {
  const OrientedSkeleton flow = oriented(smoothed(pruned(graph_of(loop_and_piece()))), {inlet});
  const SkeletonTree made = vessel_tree(flow.graph, 0.5);
  EXPECT_EQ(geometry::find_fault(made.tree), std::nullopt);
  EXPECT_EQ(made.opened_edges.size(), 1U);
  EXPECT_EQ(made.tree.segments.size(), flow.graph.edges.size());
  EXPECT_EQ(geometry::roots(made.tree).size(), 2U);
  // The limb that is opened ends, and so do the stem beyond the loop and the piece.
  EXPECT_EQ(made.tree.vessels.size(), 3U);
  double length = 0.0;
  for (const geometry::TreeSegment& s : made.tree.segments) {
    length += s.axis.abscissa.back();
    for (const double r : s.axis.radius) EXPECT_GT(r, 0.3);
  }
  EXPECT_NEAR(length, test::total_length(flow.graph), 0.01 * length);
  std::set<std::string> names;
  for (const geometry::Vessel& v : made.tree.vessels) {
    names.insert(v.name);
    EXPECT_GT(geometry::vessel_axis(made.tree, v).abscissa.back(), 15.0);
  }
  EXPECT_EQ(names.size(), 3U);
}

TEST(VesselTree, AClosedLineIsOpenedAtItsAnchor) {
  const MaskVolume ring = mask_of(grid_of(40, 40, 12), [](const Vec3& p) {
    const Vec3 q = p - Vec3(19.5, 19.5, 5.5);
    return std::hypot(std::hypot(q.x(), q.y()) - 13.0, q.z()) <= 3.0;
  });
  const SkeletonTree made = vessel_tree(oriented(pruned(graph_of(ring)), {}).graph);
  EXPECT_EQ(geometry::find_fault(made.tree), std::nullopt);
  EXPECT_EQ(made.opened_edges.size(), 1U);
  EXPECT_EQ(made.tree.vessels.size(), 1U);
}

TEST(VesselTree, RefusesWhatHasNoDirection) {
  const SkeletonGraph graph = pruned(graph_of(loop_and_piece()));
  EXPECT_THROW(vessel_tree(graph), InvalidInput);
  EXPECT_THROW(vessel_tree(oriented(graph, {inlet}).graph, 0.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
