#include "ostia/centerline/skeleton_graph.h"

#include "support/masks.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::centerline {
namespace {

using imaging::MaskVolume;
using test::graph_of;
using test::grid_of;
using test::mask_of;
using test::nodes_of;
using ::testing::HasSubstr;

constexpr double degrees = 180.0 / std::numbers::pi;

MaskVolume torus(double large, double small, const Vec3& spacing) {
  const imaging::Geometry grid = grid_of(48, 48, 24, spacing);
  const Vec3 middle = grid.world(Vec3(23.5, 23.5, 11.5));
  return mask_of(grid, [=](const Vec3& p) {
    const Vec3 q = p - middle;
    return std::hypot(std::hypot(q.x(), q.y()) - large, q.z()) <= small;
  });
}

struct Ypsilon {
  Vec3 joint{20.0, 20.0, 18.0};
  std::vector<Vec3> tips{{20.0, 20.0, 2.0}, {8.0, 20.0, 34.0}, {32.0, 20.0, 34.0}};
  MaskVolume mask(double voxel) const {
    const auto n = static_cast<std::int64_t>(40.0 / voxel);
    return mask_of(grid_of(n, n, n, Vec3::Constant(voxel)), [&](const Vec3& p) {
      return std::any_of(tips.begin(), tips.end(),
                         [&](const Vec3& t) { return test::to_segment(p, joint, t) <= 2.0; });
    });
  }
};

TEST(SkeletonGraph, ATorusIsOneLoopWithAnAnchor) {
  for (const Vec3& spacing : {Vec3(1.0, 1.0, 1.0), Vec3(0.6, 0.6, 1.25)}) {
    const double large = 15.0 * spacing.x();
    const SkeletonGraph graph = pruned(graph_of(torus(large, 4.0 * spacing.x(), spacing)));
    EXPECT_EQ(find_fault(graph), std::nullopt);
    ASSERT_EQ(graph.edges.size(), 1U);
    EXPECT_EQ(loop_count(graph), 1);
    EXPECT_EQ(nodes_of(graph, SkeletonNodeKind::loop_anchor).size(), 1U);
    // A line of voxels is at most 8 % longer than the curve that it follows; the spline takes that away.
    const double around = 2.0 * std::numbers::pi * large;
    EXPECT_NEAR(length_mm(graph.edges[0]), around, 0.1 * around);
    EXPECT_NEAR(length_mm(smoothed(graph).edges[0]), around, 0.02 * around);
  }
}

TEST(SkeletonGraph, AnYpsilonHasOneJunctionWithItsAnglesAndLengths) {
  const Ypsilon y;
  for (const double voxel : {1.0, 0.5}) {
    const MaskVolume mask = y.mask(voxel);
    const SkeletonGraph graph = smoothed(ends_extended(pruned(graph_of(mask)), mask));
    EXPECT_EQ(find_fault(graph), std::nullopt);
    ASSERT_EQ(graph.edges.size(), 3U);
    const auto junctions = nodes_of(graph, SkeletonNodeKind::junction);
    ASSERT_EQ(junctions.size(), 1U);
    EXPECT_LT((junctions[0].position - y.joint).norm(), 2.0);
    for (const SkeletonEdge& e : graph.edges) {
      const bool outward = e.from == junctions[0].id;
      const Vec3 tip = outward ? e.points.back() : e.points.front();
      const auto nearest = std::min_element(y.tips.begin(), y.tips.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - tip).norm() < (b - tip).norm();
      });
      // The tip is a half-ball of 2 mm about the axis's end.
      const double expected = (*nearest - y.joint).norm() + 2.0;
      EXPECT_NEAR(length_mm(e), expected, 1.0 + voxel);
      EXPECT_LT(test::to_segment(tip, y.joint, 2.0 * *nearest - y.joint), voxel);
      const double whole = length_mm(e);
      const Vec3 near = geometry::at_abscissa(e.points, outward ? 5.0 : whole - 5.0).point;
      const Vec3 far = geometry::at_abscissa(e.points, outward ? 13.0 : whole - 13.0).point;
      const double angle =
          std::acos(std::min(1.0, (far - near).normalized().dot((*nearest - y.joint).normalized())));
      EXPECT_LT(angle * degrees, 5.0);
    }
  }
}

TEST(SkeletonGraph, RandomBlobsKeepComponentsAndLoops) {
  int with_loops = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const Vec3 spacing = seed % 2 == 0 ? Vec3(0.6, 0.6, 1.25) : Vec3(1.0, 1.0, 1.0);
    const MaskVolume mask = test::random_blobs(seed, 28, spacing);
    const Thinned thin = thinned(mask, {.fill_cavities = true});
    const test::Topology expected = test::topology_of(thin.mask);
    const SkeletonGraph graph = skeleton_graph(thin);
    EXPECT_EQ(find_fault(graph), std::nullopt) << "seed " << seed;
    EXPECT_EQ(component_count(graph), expected.components) << "seed " << seed;
    EXPECT_EQ(loop_count(graph), expected.loops) << "seed " << seed;
    const SkeletonGraph less = pruned(graph, {.isolated = false});
    EXPECT_EQ(find_fault(less), std::nullopt) << "seed " << seed;
    EXPECT_EQ(component_count(less), expected.components) << "seed " << seed;
    EXPECT_EQ(loop_count(less), expected.loops) << "seed " << seed;
    with_loops += expected.loops > 0 ? 1 : 0;
  }
  EXPECT_GE(with_loops, 8);
}

// Dense noise makes clusters of junctions that hold loops themselves.
TEST(SkeletonGraph, RandomVoxelsKeepComponentsAndLoops) {
  std::int64_t loops = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const MaskVolume mask = test::random_voxels(seed, 12, 0.1 + 0.02 * static_cast<double>(seed));
    const Thinned thin = thinned(mask, {.fill_cavities = true});
    const test::Topology expected = test::topology_of(thin.mask);
    const SkeletonGraph graph = skeleton_graph(thin);
    EXPECT_EQ(find_fault(graph), std::nullopt) << "seed " << seed;
    EXPECT_EQ(component_count(graph), expected.components) << "seed " << seed;
    EXPECT_EQ(loop_count(graph), expected.loops) << "seed " << seed;
    loops += expected.loops;
  }
  EXPECT_GT(loops, 500);
}

TEST(SkeletonGraph, ABallIsAPoint) {
  const SkeletonGraph graph = graph_of(
      mask_of(grid_of(20, 20, 20), [](const Vec3& p) { return (p - Vec3::Constant(9.0)).norm() <= 6.0; }));
  ASSERT_EQ(graph.nodes.size(), 1U);
  EXPECT_TRUE(graph.edges.empty());
  EXPECT_EQ(graph.nodes[0].kind, SkeletonNodeKind::point);
  EXPECT_NEAR(graph.nodes[0].radius_mm, 6.0, 0.6);
}

TEST(SkeletonGraph, PlacesAreInTheWorld) {
  imaging::Geometry grid = grid_of(30, 12, 12, Vec3(0.5, 0.5, 0.8));
  grid.origin = Vec3(-40.0, 7.0, 100.0);
  grid.direction << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  const Vec3 a = grid.world(Vec3(3.0, 5.0, 5.0)), b = grid.world(Vec3(26.0, 5.0, 5.0));
  const MaskVolume mask = mask_of(grid, [&](const Vec3& p) { return test::to_segment(p, a, b) <= 1.2; });
  const SkeletonGraph graph = pruned(graph_of(mask));
  ASSERT_EQ(graph.edges.size(), 1U);
  for (const Vec3& p : graph.edges[0].points) EXPECT_LT(test::to_segment(p, a, b), 0.8);
  EXPECT_NEAR(std::abs((graph.edges[0].points.back() - graph.edges[0].points.front()).y()), 11.5, 1.6);
}

TEST(SkeletonGraph, RefusesWhatIsNoSkeletonOfCurves) {
  Thinned thick = thinned(mask_of(grid_of(8, 8, 8), [](const Vec3&) { return true; }));
  thick.mask.voxels.assign(512, 1);
  EXPECT_THROW(skeleton_graph(thick), InvalidInput);
  thick.voxels.clear();
  thick.distance_mm.clear();
  for (std::int64_t v = 0; v < 512; ++v) {
    thick.voxels.push_back(v);
    thick.distance_mm.push_back(1.0F);
  }
  try {
    skeleton_graph(thick);
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("not thin"));
  }
  const Vec3 middle = Vec3::Constant(12.0);
  const MaskVolume hollow = mask_of(grid_of(25, 25, 25), [&](const Vec3& p) {
    const double d = (p - middle).norm();
    return d <= 10.0 && d > 6.0;
  });
  EXPECT_THROW(graph_of(hollow), GeometryError);
  EXPECT_THROW(node(SkeletonGraph{}, 3), InvalidInput);
  EXPECT_THROW(edge(SkeletonGraph{}, 3), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(skeleton_graph(thinned(hollow), task), Cancelled);
}

TEST(SkeletonGraph, FaultsAreFound) {
  const Ypsilon y;
  const SkeletonGraph sound = graph_of(y.mask(1.0));
  SkeletonGraph graph = sound;
  graph.edges[0].radius_mm.pop_back();
  EXPECT_THAT(find_fault(graph).value_or(""), HasSubstr("as many of each"));
  graph = sound;
  graph.edges[0].to = 4711;
  EXPECT_THAT(find_fault(graph).value_or(""), HasSubstr("not there"));
  graph = sound;
  graph.nodes[0].kind = SkeletonNodeKind::passage;
  EXPECT_THAT(find_fault(graph).value_or(""), HasSubstr("kind"));
  graph = sound;
  graph.edges[0].points[0] += Vec3(0.1, 0.0, 0.0);
  EXPECT_THAT(find_fault(graph).value_or(""), HasSubstr("at its nodes"));
  EXPECT_THROW(pruned(graph), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
