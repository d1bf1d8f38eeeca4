#include "ostia/geometry/segment_blocks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

namespace ostia::geometry {
namespace {

/// Short segments in a cube of 100 mm about the origin; one in a hundred is 1 mm thick, the others 5 um.
VesselGraph bush(int count) {
  VesselGraph graph;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-50.0, 50.0), step(-0.2, 0.2);
  for (int i = 0; i < count; ++i) {
    const Vec3 from(place(random), place(random), place(random));
    graph.points.push_back(from);
    graph.points.push_back(from + Vec3(step(random), step(random), step(random)));
    const double radius = i % 100 == 0 ? 1.0 : 0.005;
    graph.edges.push_back({2 * i, 2 * i + 1, radius, radius});
  }
  return graph;
}

BlockView from_distance(double mm) {
  BlockView view;
  view.eye = Vec3(0.0, -mm, 0.0);
  return view;
}

std::set<std::int32_t> edges_of(const std::vector<DrawnSegment>& segments) {
  std::set<std::int32_t> edges;
  for (const DrawnSegment& one : segments) edges.insert(one.edge);
  return edges;
}

/// Where a point is in the picture, from -1 to 1 where it is within.
Vec2 seen(const BlockView& view, const Vec3& point) {
  const Vec3 at = point - view.eye;
  const double depth = -at.dot(view.back);
  return {at.dot(view.right) / depth / view.half_width, at.dot(view.up) / depth / view.half_height};
}

TEST(SegmentBlocks, HoldsEverySegmentInSinglePrecision) {
  const VesselGraph graph = bush(5000);
  const SegmentBlocks blocks(graph);
  ASSERT_EQ(blocks.size(), 5000U);
  for (std::int32_t e = 0; e < 5000; ++e) {
    const DrawnSegment* one = blocks.segment(e);
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(one->edge, e);
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      EXPECT_NEAR(one->from[k] + blocks.centre()[a], graph.points[static_cast<std::size_t>(2 * e)][a], 1e-5);
      EXPECT_NEAR(one->to[k] + blocks.centre()[a], graph.points[static_cast<std::size_t>(2 * e + 1)][a],
                  1e-5);
    }
  }
  EXPECT_EQ(blocks.segment(-1), nullptr);
  EXPECT_EQ(blocks.segment(5000), nullptr);
}

TEST(SegmentBlocks, FromAfarThickOnesAreAllThereAndThinOnesAreFew) {
  const VesselGraph graph = bush(200000);
  const SegmentBlocks blocks(graph);
  std::vector<DrawnSegment> drawn;
  const BlockChoice choice = blocks.choose(from_distance(400.0), {}, 20000, drawn);
  const std::set<std::int32_t> edges = edges_of(drawn);
  EXPECT_EQ(edges.size(), drawn.size());  // none twice
  for (std::int32_t e = 0; e < 200000; e += 100) EXPECT_TRUE(edges.count(e) == 1) << e;
  EXPECT_LE(drawn.size(), 21000U);  // a block's share is rounded up
  EXPECT_GT(drawn.size(), 15000U);
  EXPECT_EQ(choice.chosen, drawn.size());
  EXPECT_EQ(choice.chosen + choice.left_out, 200000U);
  EXPECT_EQ(choice.outside, 0U);
  // Without a limit there are as many as cover the picture, and fewer the farther away.
  std::vector<DrawnSegment> farther;
  blocks.choose(from_distance(4000.0), {}, 1000000, drawn);
  blocks.choose(from_distance(16000.0), {}, 1000000, farther);
  EXPECT_GT(drawn.size(), 20000U);
  EXPECT_LT(farther.size(), drawn.size() / 8);
}

TEST(SegmentBlocks, CloseUpEveryVisibleSegmentIsThere) {
  const VesselGraph graph = bush(200000);
  const SegmentBlocks blocks(graph);
  BlockView view = from_distance(0.0);  // within
  view.height_px = 800;
  std::vector<DrawnSegment> drawn;
  const BlockChoice choice = blocks.choose(view, {}, 1000000, drawn);
  EXPECT_GT(choice.outside, 100000U);
  const std::set<std::int32_t> edges = edges_of(drawn);
  const double px = view.height_px / (2.0 * view.half_height);
  std::size_t visible = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Vec3& from = graph.points[2 * e];
    const double depth = (from - view.eye).y();
    if (depth <= 0.0 || seen(view, from).cwiseAbs().maxCoeff() > 1.0) continue;
    if (graph.edges[e].radius_from * px / depth < 0.5) continue;
    ++visible;
    EXPECT_TRUE(edges.count(static_cast<std::int32_t>(e)) == 1) << e;
  }
  EXPECT_GT(visible, 100U);
}

/// Rods of 2 mm along z, thick enough to be seen: `count` of them at random in a slab of 100 x 100 mm whose
/// middle is at that depth, none within 10 mm of the y axis where there is a hole.
void add_slab(VesselGraph& graph, std::mt19937& random, int count, double depth, bool hole) {
  std::uniform_real_distribution<double> place(-50.0, 50.0), thickness(-5.0, 5.0);
  while (count > 0) {
    const Vec3 at(place(random), depth + thickness(random), place(random));
    if (hole && std::hypot(at.x(), at.z()) < 10.0) continue;
    const auto first = static_cast<std::int32_t>(graph.points.size());
    graph.points.push_back(at - Vec3(0.0, 0.0, 1.0));
    graph.points.push_back(at + Vec3(0.0, 0.0, 1.0));
    graph.edges.push_back({first, first + 1, 0.3, 0.3});
    --count;
  }
}

TEST(SegmentBlocks, WhatManyHideIsLeftOutWhereThereIsTooMuch) {
  VesselGraph graph;
  std::mt19937 random(3);
  constexpr std::int32_t before = 150000, behind = 10000;
  add_slab(graph, random, before, 0.0, true);
  add_slab(graph, random, behind, 100.0, false);
  const SegmentBlocks blocks(graph);
  const BlockView view = from_distance(150.0);
  std::vector<DrawnSegment> drawn;
  const BlockChoice choice = blocks.choose(view, {}, 100000, drawn);
  EXPECT_EQ(choice.chosen + choice.left_out + choice.outside + choice.hidden, graph.edges.size());
  EXPECT_LT(choice.chosen, 100000U);
  const std::set<std::int32_t> edges = edges_of(drawn);
  EXPECT_EQ(edges.size(), drawn.size());  // none twice
  std::size_t in_hole = 0, hidden = 0;
  for (std::int32_t e = before; e < before + behind; ++e) {
    const Vec3& at = graph.points[static_cast<std::size_t>(2 * e)];
    // The slab's hole is 10 mm at 145 to 155 mm from the eye; tiles are 16 pixels.
    const double from_middle = std::hypot(at.x(), at.z()) * 150.0 / (at.y() + 150.0);
    if (from_middle < 6.0) {
      EXPECT_EQ(edges.count(e), 1U) << e;
      ++in_hole;
    }
    if (from_middle > 14.0 && std::max(std::abs(at.x()), std::abs(at.z())) < 45.0) {
      EXPECT_EQ(edges.count(e), 0U) << e;
      ++hidden;
    }
  }
  EXPECT_GT(in_hole, 200U);
  EXPECT_GT(hidden, 4000U);
  // Nearest first, but for slices of depth.
  for (std::size_t i = 1; i < drawn.size(); ++i) EXPECT_GT(drawn[i].from[1], drawn[i - 1].from[1] - 0.5f);
  // Where there is room for all, all are there.
  EXPECT_EQ(blocks.choose(view, {}, graph.edges.size(), drawn).hidden, 0U);
}

TEST(SegmentBlocks, LeavesOutWhatIsNotWanted) {
  const VesselGraph graph = bush(50000);
  const SegmentBlocks blocks(graph);
  std::vector<std::uint8_t> shown(graph.edges.size(), 0);
  for (std::size_t e = 0; e < shown.size(); e += 7) shown[e] = 1;
  std::vector<DrawnSegment> drawn;
  const BlockChoice choice = blocks.choose(from_distance(200.0), shown, 1000000, drawn);
  for (const DrawnSegment& one : drawn) EXPECT_EQ(one.edge % 7, 0);
  EXPECT_GT(drawn.size(), 3000U);
  EXPECT_EQ(choice.chosen + choice.left_out, 50000U / 7 + 1);
}

TEST(SegmentBlocks, TheSameForAnyNumberOfThreads) {
  const VesselGraph graph = bush(30000);
  std::vector<DrawnSegment> one, other;
  core::set_max_threads(1);
  SegmentBlocks(graph).choose(from_distance(300.0), {}, 5000, one);
  core::set_max_threads(0);
  SegmentBlocks(graph).choose(from_distance(300.0), {}, 5000, other);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].edge, other[i].edge);
}

TEST(SegmentBlocks, TakesWhatFilesHold) {
  const SegmentBlocks none(VesselGraph{});
  std::vector<DrawnSegment> drawn;
  EXPECT_EQ(none.choose(from_distance(1.0), {}, 10, drawn).chosen, 0U);
  VesselGraph graph = bush(3);
  graph.points[2].x() = std::numeric_limits<double>::quiet_NaN();
  graph.edges[2].radius_from = std::numeric_limits<double>::quiet_NaN();
  graph.edges[2].radius_to = -1.0;
  const SegmentBlocks blocks(graph);
  EXPECT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks.segment(1), nullptr);
  EXPECT_EQ(blocks.segment(2)->radius_from, 0.0f);
  EXPECT_EQ(blocks.segment(2)->radius_to, 0.0f);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(SegmentBlocks(graph, task), Cancelled);
}

}  // namespace
}  // namespace ostia::geometry
