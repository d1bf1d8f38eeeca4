// Trees solved: against sums of resistances; the Jacobian against differences; from a hair's breadth to an
// ectasia.

#include "flow_networks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::hemodynamics {
namespace {

using testing::circle_mm2, testing::friction_alone, testing::narrowed, testing::poiseuille_pa_s_ml,
    testing::tube_of, testing::vessel_of;

constexpr double inlet_pa = 93.0 * 133.322387415;

/// A trunk, a fork with angles, one branch that forks again: three outlets.
Network three_outlets(double least = 0.5) {
  Network network;
  network.branches = {tube_of(20.0, 2.0), vessel_of(40.0, narrowed(1.6, 20.0, 10.0, least), 0),
                      tube_of(30.0, 1.3, 0), tube_of(25.0, 1.1, 1), tube_of(35.0, 1.2, 1)};
  network.branches[1].angle_rad = -0.3;
  network.branches[2].angle_rad = 0.7;
  network.branches[3].angle_rad = 0.5;
  network.branches[4].angle_rad = -0.2;
  return network;
}

Boundary beds(std::size_t outlets, double resistance = 12000.0) {
  return {inlet_pa, std::nullopt, std::vector<Outlet>(outlets, Outlet{resistance, 650.0, {}})};
}

TEST(NetworkSolver, AddsResistancesInARow) {
  Network network;
  network.branches = {tube_of(20.0, 2.0), tube_of(30.0, 1.5, 0), tube_of(40.0, 1.0, 1)};
  const double sum =
      poiseuille_pa_s_ml(20.0, 2.0) + poiseuille_pa_s_ml(30.0, 1.5) + poiseuille_pa_s_ml(40.0, 1.0);
  const Solution s = solve(PreparedNetwork(network, friction_alone()), beds(1));
  EXPECT_NEAR(s.flow_ml_s[0] / ((inlet_pa - 650.0) / (sum + 12000.0)), 1.0, 1e-9);
}

TEST(NetworkSolver, AddsConductancesBesideEachOther) {
  Network network;
  network.branches = {tube_of(20.0, 2.0), tube_of(30.0, 1.5, 0), tube_of(40.0, 1.0, 0),
                      tube_of(25.0, 0.8, 0)};
  double conductance = 0.0;
  for (const auto& [length, radius] : {std::pair{30.0, 1.5}, std::pair{40.0, 1.0}, std::pair{25.0, 0.8}})
    conductance += 1.0 / (poiseuille_pa_s_ml(length, radius) + 12000.0);
  const double whole = poiseuille_pa_s_ml(20.0, 2.0) + 1.0 / conductance;
  const Solution s = solve(PreparedNetwork(network, friction_alone()), beds(3));
  EXPECT_NEAR(s.flow_ml_s[0] / ((inlet_pa - 650.0) / whole), 1.0, 1e-9);
  EXPECT_NEAR(s.flow_ml_s[1] + s.flow_ml_s[2] + s.flow_ml_s[3], s.flow_ml_s[0], 1e-12);
}

TEST(NetworkSolver, HasTheExactJacobian) {
  const PreparedNetwork network(three_outlets(), {});
  const Boundary boundary = beds(3);
  const std::vector<double> flows = {0.9, 0.4, 0.7};
  const Residuals at = residuals(network, boundary, inlet_pa, flows);
  for (std::size_t j = 0; j < 3; ++j) {
    std::vector<double> more = flows, less = flows;
    more[j] += 1e-6, less[j] -= 1e-6;
    const Residuals up = residuals(network, boundary, inlet_pa, more);
    const Residuals down = residuals(network, boundary, inlet_pa, less);
    for (std::size_t i = 0; i < 3; ++i) {
      const double slope = (up.pa[i] - down.pa[i]) / 2e-6;
      EXPECT_NEAR(at.jacobian_pa_s_ml[3 * i + j], slope, 1e-4 * std::max(1.0, std::abs(slope)));
    }
  }
}

TEST(NetworkSolver, KeepsMassAndPressure) {
  const PreparedNetwork network(three_outlets(), {});
  const Solution s = solve(network, beds(3));
  EXPECT_LE(s.residual_pa, 1e-9 * inlet_pa);
  EXPECT_NEAR(s.flow_ml_s[0], s.flow_ml_s[1] + s.flow_ml_s[2], 1e-12);
  for (const std::size_t outlet : network.outlets())
    EXPECT_NEAR(s.to_pa[outlet], 650.0 + 12000.0 * s.flow_ml_s[outlet], 1e-4);
  EXPECT_LE(s.iterations, 15);
}

TEST(NetworkSolver, SolvesFromAHairToAnEctasia) {
  double before = HUGE_VAL;
  for (const double least : {3.0, 1.0, 0.7, 0.5, 0.3, 0.2, 0.1, 0.03, 0.01}) {  // of the radius
    const Solution s = solve(PreparedNetwork(three_outlets(least), {}), beds(3, 2500.0));
    for (const double value : s.flow_ml_s) EXPECT_TRUE(std::isfinite(value)) << least;
    for (const double value : s.to_pa) EXPECT_TRUE(std::isfinite(value)) << least;
    if (least <= 1.0) {
      EXPECT_LT(s.flow_ml_s[1], before) << least;
      before = s.flow_ml_s[1];
    }
  }
  EXPECT_LT(before, 1e-3);
}

TEST(NetworkSolver, LeavesNothingToAnOccludedBranch) {
  Network network = three_outlets();
  network.branches[1].stations[30].area_mm2 = 0.0;
  const PreparedNetwork prepared(network, {});
  const Solution s = solve(prepared, beds(3));
  for (const std::size_t shut : {1u, 3u, 4u}) {
    EXPECT_EQ(s.flow_ml_s[shut], 0.0);
    EXPECT_EQ(s.to_pa[shut], 650.0);
    EXPECT_TRUE(prepared.beyond_occlusion(shut));
  }
  EXPECT_GT(s.flow_ml_s[2], 0.0);
  EXPECT_EQ(s.flow_ml_s[0], s.flow_ml_s[2]);
  EXPECT_EQ(along(prepared, s, 1)[10].pressure_pa, s.from_pa[1]);
  // All shut: nothing flows, and the pressure before is the aorta's.
  network.branches[0].stations[5].area_mm2 = 0.0;
  const Solution none = solve(PreparedNetwork(network, {}), beds(3));
  EXPECT_EQ(none.flow_ml_s[0], 0.0);
  EXPECT_EQ(none.from_pa[0], inlet_pa);
}

TEST(NetworkSolver, IsTheSameAfterAnEditAsFromTheStart) {
  const PreparedNetwork before(three_outlets(0.8), {});
  const Boundary boundary = beds(3, 2500.0);
  const Solution first = solve(before, boundary);
  const PreparedNetwork edited = before.with_branch(1, three_outlets(0.45).branches[1]);
  EXPECT_EQ(&edited.branch(2), &before.branch(2));
  const Solution warm = solve(edited, boundary, &first);
  const Solution cold = solve(PreparedNetwork(three_outlets(0.45), {}), boundary);
  for (std::size_t b = 0; b < edited.size(); ++b) {
    EXPECT_NEAR(warm.to_pa[b], cold.to_pa[b], 1e-9 * inlet_pa);
    EXPECT_NEAR(warm.flow_ml_s[b], cold.flow_ml_s[b], 1e-9);
  }
  EXPECT_LT(cold.to_pa[1], first.to_pa[1]);
}

TEST(NetworkSolver, IsTheSameForAnyNumberOfThreads) {
  const PreparedNetwork network(three_outlets(), {});
  std::vector<Solution> solutions;
  for (const int threads : {1, 2, 5}) {
    core::set_max_threads(threads);
    solutions.push_back(solve(network, beds(3)));
  }
  core::set_max_threads(0);
  for (const Solution& s : solutions) {
    EXPECT_EQ(s.flow_ml_s, solutions.front().flow_ml_s);
    EXPECT_EQ(s.to_pa, solutions.front().to_pa);
  }
}

TEST(NetworkSolver, SolvesRandomTrees) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int tree = 0; tree < 200; ++tree) {
    Network network;
    for (int b = 0; b < 12; ++b) {
      const int parent = b == 0 ? -1 : (b - 1) / 2;
      const double radius =
          (parent < 0
               ? 2.2
               : std::sqrt(network.branches[static_cast<std::size_t>(parent)].stations.back().area_mm2 /
                           std::numbers::pi)) *
          (0.65 + 0.3 * uniform(random));
      const double least = uniform(random) < 0.4 ? 0.05 + 0.95 * uniform(random) : 1.0;
      Branch branch = vessel_of(15.0 + 30.0 * uniform(random), narrowed(radius, 12.0, 8.0, least), parent);
      branch.angle_rad = (b % 2 == 0 ? -1.0 : 1.0) * uniform(random);
      for (Station& station : branch.stations) station.curvature_per_mm = 0.05 * uniform(random);
      network.branches.push_back(std::move(branch));
    }
    const PreparedNetwork prepared(network, {});
    const Solution s = solve(prepared, beds(prepared.outlets().size(), 1500.0 + 8000.0 * uniform(random)));
    EXPECT_LE(s.residual_pa, 1e-8 * inlet_pa) << tree;
    for (std::size_t b = 0; b < prepared.size(); ++b)
      for (const StationFlow& station : along(prepared, s, b))
        ASSERT_TRUE(std::isfinite(station.pressure_pa) && std::isfinite(station.wall_shear_pa)) << tree;
  }
}

TEST(NetworkSolver, FromTheAortaBloodIsSetInMotionFirst) {
  FlowModel model;
  model.from_rest = true;
  // Through an ostium as narrow as a throat pressure never rises above the aorta's.
  Network network;
  network.branches = {vessel_of(60.0, [](double s) { return s < 2.0 ? 0.8 : 2.8; })};
  const PreparedNetwork prepared(network, model);
  const Solution s = solve(prepared, beds(1, 300.0));
  const double speed = s.flow_ml_s[0] / circle_mm2(0.8);
  EXPECT_NEAR(s.from_pa[0], inlet_pa - 0.5 * 1060.0 * speed * speed, 1e-6 * inlet_pa);
  for (const StationFlow& station : along(prepared, s, 0)) EXPECT_LT(station.pressure_pa, inlet_pa);
}

TEST(NetworkSolver, TakesAToldFlow) {
  Boundary boundary = beds(3);
  boundary.outlets[2].flow_ml_s = 0.4;
  const Solution s = solve(PreparedNetwork(three_outlets(), {}), boundary);
  EXPECT_NEAR(s.flow_ml_s[4], 0.4, 1e-12);
  boundary.outlets[2].flow_ml_s.reset();
  boundary.inlet_flow_ml_s = 1.7;
  const Solution by_flow = solve(PreparedNetwork(three_outlets(), {}), boundary);
  EXPECT_NEAR(by_flow.flow_ml_s[0], 1.7, 1e-9);
  EXPECT_NEAR(by_flow.to_pa[2], 650.0 + 12000.0 * by_flow.flow_ml_s[2], 1e-4);
}

TEST(NetworkSolver, RefusesWhatIsNoBoundary) {
  const PreparedNetwork network(three_outlets(), {});
  EXPECT_THROW(solve(network, beds(2)), InvalidInput);
  Boundary boundary = beds(3);
  boundary.outlets[0].resistance_pa_s_ml = -1.0;
  EXPECT_THROW(solve(network, boundary), InvalidInput);
  boundary = beds(3);
  boundary.inlet_flow_ml_s = 1.0;
  for (Outlet& outlet : boundary.outlets) outlet.flow_ml_s = 0.3;
  EXPECT_THROW(solve(network, boundary), InvalidInput);
  Network wrong = three_outlets();
  wrong.branches[1].parent = 3;
  EXPECT_THROW(PreparedNetwork(wrong, {}), InvalidInput);
  EXPECT_THROW(PreparedNetwork(Network{}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::hemodynamics
