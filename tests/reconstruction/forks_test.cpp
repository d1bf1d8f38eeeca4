#include "test_graphs.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/reconstruction/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace ostia;
using namespace ostia::reconstruction;
using namespace ostia::reconstruction::testing;

/// Area of the star around an axis in the plane across it: less than the section's only where it is not
/// star-shaped, so that what passes is no bottleneck.
double clear_area(const geometry::AabbTree& tree, const Vec3& centre, const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  constexpr int rays = 64;
  std::vector<double> r;
  for (int k = 0; k < rays; ++k) {
    const double t = 2.0 * std::numbers::pi * k / rays;
    const auto hit = tree.first_hit(centre, std::cos(t) * u + std::sin(t) * v);
    r.push_back(hit ? hit->t : 0.0);
  }
  double area = 0.0;
  for (int k = 0; k < rays; ++k)
    area += 0.5 * r[static_cast<std::size_t>(k)] * r[static_cast<std::size_t>((k + 1) % rays)] *
            std::sin(2.0 * std::numbers::pi / rays);
  return area;
}

void expect_open_and_sound(const VesselGraph& graph, int level) {
  ReconstructionOptions options;
  options.level = level;
  const auto made = reconstruct_surface(graph, options);
  const auto faults = geometry::find_faults(made.surface.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.self_intersections, 0u);
  EXPECT_EQ(faults.components, 1u);
  EXPECT_TRUE(made.narrowed.empty()) << made.narrowed.size() << " narrowed";
  const geometry::AabbTree tree(made.surface.mesh);
  for (const geometry::GraphEdge& edge : graph.edges) {
    const Vec3 from = graph.points[static_cast<std::size_t>(edge.from)];
    const Vec3 along = graph.points[static_cast<std::size_t>(edge.to)] - from;
    const double whole = std::numbers::pi * edge.radius_from * edge.radius_from;
    for (double t = 0.02; t < 1.0; t += 0.04)
      EXPECT_GE(clear_area(tree, from + t * along, along.normalized()), 0.9 * whole) << "at " << t;
  }
}

struct Case {
  double angle, ratio;
};
class Forks : public ::testing::TestWithParam<Case> {};

TEST_P(Forks, ASideBranchIsOpenAndSound) {
  expect_open_and_sound(side_branch(GetParam().angle, GetParam().ratio), 1);
}

TEST_P(Forks, TwoEqualChildrenAreOpenAndSound) {
  expect_open_and_sound(y_fork(GetParam().angle, GetParam().ratio), 1);
}

std::vector<Case> grid() {
  std::vector<Case> cases;
  for (const double angle : {10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0})
    for (const double ratio : {0.1, 0.4, 0.7, 1.0}) cases.push_back({angle, ratio});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Grid, Forks, ::testing::ValuesIn(grid()), [](const auto& at) {
  return "angle" + std::to_string(static_cast<int>(at.param.angle)) + "ratio" +
         std::to_string(static_cast<int>(100.0 * at.param.ratio));
});

TEST(Joint, AChildMayLieAtAnyRollAboutTheTrunk) {
  for (const double roll : {0.0, 22.5, 45.0, 67.5, 90.0})
    expect_open_and_sound(side_branch(70.0, 0.6, roll), 1);
}

/// Of two children beside a trunk that goes on, this angle from it and that one about it.
double length_beside(double angle, double roll) {
  const double between =
      2.0 * std::asin(std::sin(angle * std::numbers::pi / 180.0) * std::sin(roll * std::numbers::pi / 360.0));
  return clear_length(std::min(angle, between * 180.0 / std::numbers::pi), 1.0);
}

class ForksOfThree : public ::testing::TestWithParam<Case> {};

/// Each child makes this angle with the trunk's direction.
TEST_P(ForksOfThree, SpreadEvenlyAboutTheTrunkTheyAreOpenAndSound) {
  const auto [angle, ratio] = GetParam();
  const double length = clear_length(angle, 1.0);
  std::vector<Child> children;
  for (const double roll : {0.0, 120.0, 240.0}) children.push_back({direction(angle, roll), ratio, length});
  expect_open_and_sound(fork(1.0, length, children), 1);
}

TEST_P(ForksOfThree, TwoBesideATrunkThatGoesOnAreOpenAndSound) {
  const auto [angle, ratio] = GetParam();
  for (const double roll : {60.0, 120.0, 180.0}) {
    const double length = length_beside(angle, roll);
    SCOPED_TRACE("roll " + std::to_string(roll));
    expect_open_and_sound(fork(1.0, length,
                               {{Vec3::UnitX(), 1.0, length},
                                {direction(angle), ratio, length},
                                {direction(angle, roll), ratio, length}}),
                          1);
  }
}

std::vector<Case> grid_of_three() {
  std::vector<Case> cases;
  for (const double angle : {10.0, 30.0, 60.0, 90.0})
    for (const double ratio : {0.1, 0.2, 0.4, 0.7, 1.0}) cases.push_back({angle, ratio});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Grid, ForksOfThree, ::testing::ValuesIn(grid_of_three()), [](const auto& at) {
  return "angle" + std::to_string(static_cast<int>(at.param.angle)) + "ratio" +
         std::to_string(static_cast<int>(100.0 * at.param.ratio));
});

TEST(ForksOfThreeFine, AreOpenAndSoundAtLevelTwo) {
  for (const double angle : {30.0, 60.0, 90.0})
    for (const double ratio : {0.4, 0.7, 1.0}) {
      SCOPED_TRACE(std::to_string(angle) + " degrees, ratio " + std::to_string(ratio));
      const double length = clear_length(angle, 1.0);
      std::vector<Child> children;
      for (const double roll : {0.0, 120.0, 240.0})
        children.push_back({direction(angle, roll), ratio, length});
      expect_open_and_sound(fork(1.0, length, children), 2);
    }
}

/// Without crossings and as they were: what joints that stay as at level 1 are for.
TEST(ForksOfThreeFine, ThinChildrenBesideATrunkAreSoundAtLevelTwo) {
  ReconstructionOptions options;
  options.level = 2;
  for (const double angle : {10.0, 20.0, 30.0, 50.0})
    for (const double ratio : {0.1, 0.2, 0.3})
      for (const double roll : {60.0, 120.0, 180.0}) {
        SCOPED_TRACE(std::to_string(angle) + " degrees, ratio " + std::to_string(ratio) + ", roll " +
                     std::to_string(roll));
        const double length = length_beside(angle, roll);
        const auto made = reconstruct_surface(fork(1.0, length,
                                                   {{Vec3::UnitX(), 1.0, length},
                                                    {direction(angle), ratio, length},
                                                    {direction(angle, roll), ratio, length}}),
                                              options);
        const auto faults = geometry::find_faults(made.surface.mesh, true);
        EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
        EXPECT_EQ(faults.self_intersections, 0u);
        EXPECT_TRUE(made.narrowed.empty());
        EXPECT_TRUE(made.moved.empty());
      }
}

TEST(ForksFine, ThinChildrenNearEachOtherAreSoundAtLevelTwo) {
  ReconstructionOptions options;
  options.level = 2;
  for (const double apart : {2.0, 3.0})
    for (const double angle : {20.0, 30.0, 60.0})
      for (const double roll : {60.0, 180.0}) {
        SCOPED_TRACE(std::to_string(apart) + " radii, " + std::to_string(angle) + " degrees, roll " +
                     std::to_string(roll));
        const double length = length_beside(angle, roll);
        VesselGraph graph;
        graph.points = {{-length, 0, 0}, {0, 0, 0}, {apart, 0, 0}, {length, 0, 0}};
        graph.points.push_back(length * direction(angle));
        graph.points.push_back(length * direction(angle, roll));
        graph.edges = {{0, 1, 1, 1}, {1, 2, 1, 1}, {2, 3, 1, 1}, {1, 4, 0.1, 0.1}, {2, 5, 0.1, 0.1}};
        const auto made = reconstruct_surface(graph, options);
        const auto faults = geometry::find_faults(made.surface.mesh, true);
        EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
        EXPECT_EQ(faults.self_intersections, 0u);
      }
}

TEST(ForksFine, ThinSideBranchesAreOpenAndSoundAtLevelTwo) {
  for (const double angle : {10.0, 20.0, 30.0, 50.0, 90.0, 130.0, 150.0, 170.0})
    for (const double ratio : {0.1, 0.15, 0.2}) {
      SCOPED_TRACE(std::to_string(angle) + " degrees, ratio " + std::to_string(ratio));
      expect_open_and_sound(side_branch(angle, ratio, 30.0), 2);
    }
}

TEST(Joint, TwoNearForksShareTheRoomBetweenThem) {
  // Two side branches 1.2 radii apart on a trunk, on opposite sides, thin ones that must leave its wall.
  VesselGraph graph = fork(1.0, 8.0, {{Vec3::UnitX(), 1.0, 1.2}, {Vec3::UnitY(), 0.2, 6.0}});
  graph.points.emplace_back(9.2, 0.0, 0.0);
  graph.edges.push_back({2, 4, 1.0, 1.0});
  graph.points.emplace_back(1.2, -6.0, 0.0);
  graph.edges.push_back({2, 5, 0.2, 0.2});
  expect_open_and_sound(graph, 1);
}

}  // namespace
