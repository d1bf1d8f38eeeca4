// Forks that need room: the axes are moved where the vessels would cross, and nowhere else.

#include "test_graphs.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/reconstruction/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;
using namespace ostia::reconstruction::testing;

ReconstructedSurface made_of(const VesselGraph& graph, int level) {
  ReconstructionOptions options;
  options.level = level;
  return reconstruct_surface(graph, options);
}

void fork_spacing_expect_sound(const ReconstructedSurface& made) {
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.self_intersections, 0u);
  EXPECT_EQ(faults.components, 1u);
}

/// The nearest that the surface comes to a point.
double distance_to(const ReconstructedSurface& made, const Vec3& point) {
  double least = 1e300;
  for (const Vec3& p : made.points) least = std::min(least, (p - point).norm());
  return least;
}

/// The root, and vessels of a chain of short pieces that each give off a branch, by turns on either side.
VesselGraph crowded(double spacing, double radius) {
  VesselGraph graph;
  graph.points = {{-12.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  graph.edges = {{0, 1, 1.0, 1.0}};
  std::int32_t trunk = 1;
  for (int i = 0; i < 4; ++i) {
    const Vec3 here = graph.points[static_cast<std::size_t>(trunk)];
    const auto next = static_cast<std::int32_t>(graph.points.size());
    graph.points.push_back(here + (i == 3 ? 12.0 : spacing) * Vec3::UnitX());
    graph.points.push_back(here + 12.0 * direction(70.0, 100.0 * i));
    graph.edges.push_back({trunk, next, 1.0, 1.0});
    graph.edges.push_back({trunk, next + 1, radius, radius});
    trunk = next;
  }
  return graph;
}

class Room : public ::testing::TestWithParam<int> {};

TEST_P(Room, ChildrenSideBySideArePartedAndEndWhereTheyShould) {
  for (const double degrees : {2.0, 5.0, 12.0}) {
    const VesselGraph graph =
        fork(1.0, 12.0, {{direction(0.5 * degrees), 0.8, 60.0}, {direction(-0.5 * degrees), 0.8, 80.0}});
    const auto made = made_of(graph, GetParam());
    fork_spacing_expect_sound(made);
    // The longer one's end lies clear of the other: it is where it was. A cap's ring is a radius away.
    EXPECT_LT(distance_to(made, graph.points[3]), 1e-6) << degrees;
    EXPECT_LT(distance_to(made, graph.points[0]), 1e-6) << degrees;
  }
}

TEST_P(Room, ABranchThatForksWithinAWideVesselIsBroughtOutOfIt) {
  VesselGraph graph;
  graph.points = {{-30.0, 0.0, 0.0}, {0.0, 0.0, 0.0},   {30.0, 0.0, 0.0},
                  {0.0, 2.5, 0.0},   {-1.0, 12.0, 0.0}, {1.5, 14.0, 0.0}};
  graph.edges = {{0, 1, 4.0, 4.0}, {1, 2, 4.0, 4.0}, {1, 3, 0.4, 0.4}, {3, 4, 0.4, 0.4}, {3, 5, 0.3, 0.3}};
  const auto made = made_of(graph, GetParam());
  fork_spacing_expect_sound(made);
  EXPECT_THAT(made.moved, ::testing::Contains(2));
  EXPECT_LT(distance_to(made, graph.points[2]), 1e-6);
}

TEST_P(Room, ForksInARowAreSpreadAlongTheTrunk) {
  for (const double spacing : {0.4, 0.8}) {
    const auto made = made_of(crowded(spacing, 0.5), GetParam());
    fork_spacing_expect_sound(made);
    EXPECT_FALSE(made.moved.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Room, ::testing::Values(0, 1, 2));

TEST(Room, NothingIsMovedWhereNothingCrosses) {
  EXPECT_TRUE(made_of(y_fork(70.0, 0.8), 1).moved.empty());
  EXPECT_TRUE(made_of(side_branch(80.0, 0.5), 1).moved.empty());
  const auto spread = made_of(crowded(6.0, 0.5), 1);
  fork_spacing_expect_sound(spread);
  EXPECT_TRUE(spread.moved.empty());
  EXPECT_TRUE(spread.narrowed.empty());
}

}  // namespace
