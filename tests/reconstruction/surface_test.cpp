#include "ostia/reconstruction/surface.h"

#include "test_graphs.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;
using reconstruction::testing::torus;
using reconstruction::testing::tube;
using std::numbers::pi;

ReconstructionOptions surface_at_level(int level) {
  ReconstructionOptions options;
  options.level = level;
  return options;
}

class Levels : public ::testing::TestWithParam<int> {};

TEST_P(Levels, AStraightTubeHasItsVolumeAndIsClosed) {
  const auto made = reconstruct_surface(tube(20.0, 1.0), surface_at_level(GetParam()));
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
  EXPECT_NEAR(geometry::volume(made.surface.mesh), 20.0 * pi, 20.0 * pi * 1e-9);
  EXPECT_EQ(made.surface.mesh.triangles.size(), 2 * made.quads.size());
  EXPECT_EQ(made.surface.faces.size(), 3u);
  EXPECT_TRUE(made.narrowed.empty());
}

TEST_P(Levels, ALoopIsATorus) {
  const auto made = reconstruct_surface(torus(10.0, 1.0, 48), surface_at_level(GetParam()));
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  const double truth = 2.0 * pi * pi * 10.0;
  EXPECT_NEAR(geometry::volume(made.surface.mesh), truth, (GetParam() == 0 ? 0.05 : 0.015) * truth);
  double worst = 0.0;
  for (const auto& p : made.points)
    worst = std::max(worst, std::abs(std::hypot(std::hypot(p.x(), p.y()) - 10.0, p.z()) - 1.0));
  EXPECT_LT(worst, 0.08);
}

INSTANTIATE_TEST_SUITE_P(All, Levels, ::testing::Range(0, 4));

TEST(Surface, IsTheSameForAnyNumberOfThreads) {
  const auto graph = reconstruction::testing::y_fork(60.0, 0.8);
  core::set_max_threads(1);
  const auto one = reconstruct_surface(graph, surface_at_level(2));
  core::set_max_threads(4);
  const auto four = reconstruct_surface(graph, surface_at_level(2));
  core::set_max_threads(0);
  EXPECT_EQ(one.quads, four.quads);
  EXPECT_EQ(one.points, four.points);
}

TEST(Surface, KeepsPartsAndSeveralRootsApart) {
  geometry::VesselGraph graph = tube(20.0, 1.0);
  graph.points.emplace_back(0.0, 10.0, 0.0);
  graph.points.emplace_back(20.0, 10.0, 0.0);
  graph.edges.push_back({3, 2, 0.5, 0.5});
  const auto made = reconstruct_surface(graph, surface_at_level(1));
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 2u);
  EXPECT_NEAR(geometry::volume(made.surface.mesh), 20.0 * pi * 1.25, 1e-6);
}

TEST(Surface, JoinsTwoVesselsThatArriveAtOnePoint) {
  geometry::VesselGraph graph = tube(20.0, 1.0, 2);
  std::swap(graph.edges[1].from, graph.edges[1].to);  // both run to the middle
  const auto made = reconstruct_surface(graph, surface_at_level(1));
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.components, 1u);
  EXPECT_NEAR(geometry::volume(made.surface.mesh), 20.0 * pi, 0.01 * 20.0 * pi);
}

TEST(Surface, RefusesWhatIsNoNetwork) {
  EXPECT_THROW(reconstruct_surface({}), InvalidInput);
  auto zero = tube(10.0, 1.0);
  zero.edges[0].radius_to = 0.0;
  EXPECT_THROW(reconstruct_surface(zero), InvalidInput);
  auto nan = tube(10.0, 1.0);
  nan.points[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(reconstruct_surface(nan), InvalidInput);
  auto lost = tube(10.0, 1.0);
  lost.edges[0].to = 7;
  EXPECT_THROW(reconstruct_surface(lost), InvalidInput);
  ReconstructionOptions odd;
  odd.sides = 7;
  try {
    reconstruct_surface(tube(10.0, 1.0), odd);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("sides"));
  }
}

TEST(Surface, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(reconstruct_surface(tube(10.0, 1.0), {}, task), Cancelled);
}

}  // namespace
