// Jets: how they mix, what a bend makes of them, and where they go at a fork.

#include "flow_networks.h"

#include "ostia/hemodynamics/stenosis_formulas.h"

#include <gtest/gtest.h>

namespace ostia::hemodynamics {
namespace {

using testing::circle_mm2, testing::narrowed, testing::poiseuille_pa_s_ml, testing::tube_of,
    testing::vessel_of;

constexpr double developed = 4.0 / 3.0;

FlowModel with_developed_root() {
  FlowModel model;
  model.root_momentum = developed;
  return model;
}

/// On an arc of a circle from `from_mm` on, straight before.
Branch bent(Branch branch, double radius_mm, double from_mm) {
  for (Station& station : branch.stations) {
    const double way = station.s_mm - from_mm;
    if (way <= 0.0) continue;
    station.point = Vec3(radius_mm * (1.0 - std::cos(way / radius_mm)), 0.0,
                         from_mm + radius_mm * std::sin(way / radius_mm));
  }
  return branch;
}

TEST(Jets, KeepTheirMomentumFirst) {
  // A strong jet: free laminar ones keep their momentum, and confined ones lose it late (wedge of 28 cells
  // across, throat of 1 mm in 3.9 mm at 1.08 ml/s: 17.3 behind the throat, 15.8 after 11 mm, 11.1 after 25).
  const Branch branch = vessel_of(45.0, narrowed(1.935, 9.65, 5.3, 0.2565), -1, 0.1);
  const auto along =
      pressure_along(prepare(branch, with_developed_root()), with_developed_root(), 1.081, 0.0);
  const auto at = [&](double s) { return along[static_cast<std::size_t>(s / 0.1 + 0.5)].momentum; };
  EXPECT_GT(at(12.5), 14.0);
  EXPECT_NEAR(at(23.6) / 15.8, 1.0, 0.35);
  EXPECT_NEAR(at(37.6) / 11.1, 1.0, 0.35);
}

TEST(Jets, OfARoundStenosisAreWhatAFineComputationHas) {
  // Two more wedges, of 28 cells across: 3D's mmHg lost from the beginning to the throat's end, and in all.
  struct Wedge {
    double radius, least, length, shoulder, flow, throat_mmhg, all_mmhg, to_mm;
  };
  for (const Wedge& w : {Wedge{1.228, 0.3655, 14.2, 4.3, 0.7035, 18.1, 15.43, 45.7},
                         Wedge{1.935, 0.2565, 5.3, 1.4, 1.081, 17.4, 15.84, 40.3}}) {
    const double middle = 7.0 + 0.5 * w.length;
    const auto radius = [&](double s) {
      const double in = 0.5 * w.length - std::abs(s - middle);
      const double depth = in <= 0.0          ? 0.0
                           : in >= w.shoulder ? 1.0
                                              : 0.5 * (1.0 - std::cos(std::numbers::pi * in / w.shoulder));
      return w.radius * (1.0 - (1.0 - w.least) * depth);
    };
    const auto along = pressure_along(prepare(vessel_of(w.to_mm, radius, -1, 0.1), with_developed_root()),
                                      with_developed_root(), w.flow, 0.0);
    double lowest = 0.0;
    for (const StationFlow& station : along) lowest = std::min(lowest, station.pressure_pa);
    EXPECT_NEAR(-lowest / 133.322387415, w.throat_mmhg, 0.6) << w.radius;
    EXPECT_NEAR(-along.back().pressure_pa / 133.322387415, w.all_mmhg, 0.6) << w.radius;
  }
}

TEST(Jets, LeanOnTheWallOfABend) {
  const Branch straight = vessel_of(50.0, narrowed(1.25, 12.0, 10.0, 0.4), -1, 0.25);
  const auto lost = [&](const Branch& branch, const FlowModel& model) {
    return pressure_drop(prepare(branch, model), model, 0.8).pa;
  };
  const FlowModel model = with_developed_root();
  const double in_bend = lost(bent(straight, 20.0, 5.0), model), on = lost(straight, model);
  // No curvature is told: White's law has no part in it. Less pressure comes back.
  EXPECT_GT(in_bend, on + 50.0);
  EXPECT_LT(in_bend, on + 400.0);
  FlowModel without = model;
  without.bends = false;
  EXPECT_NEAR(lost(bent(straight, 20.0, 5.0), without), lost(straight, without), 1e-9 * on);
  // A tube in the same bend has no jet, and its loss is the straight one's.
  EXPECT_NEAR(lost(bent(tube_of(50.0, 1.25), 20.0, 5.0), model) / lost(tube_of(50.0, 1.25), model), 1.0,
              1e-9);
}

TEST(Jets, LeanIsNoneInAStraightVesselAndAllInATightBend) {
  const Branch straight = vessel_of(40.0, narrowed(1.5, 10.0, 8.0, 0.5), -1, 0.25);
  for (const PreparedBranch::Step& step : prepare(straight, {}).steps) EXPECT_LT(step.lean, 1e-6);
  const auto steps = prepare(bent(straight, 10.0, 5.0), {}).steps;
  EXPECT_EQ(steps.front().lean, 0.0);
  EXPECT_EQ(steps.back().lean, 1.0);  // and stays there when it is as wide as the lumen
}

/// A trunk that ends behind its throat, and two branches.
Network trunk_with_a_jet(double side_deg = 55.0) {
  Network network;
  network.branches = {vessel_of(16.0, narrowed(1.8, 10.0, 8.0, 0.4)), tube_of(40.0, 1.5, 0),
                      tube_of(30.0, 1.2, 0)};
  network.branches[1].angle_rad = -15.0 * std::numbers::pi / 180.0;
  network.branches[2].angle_rad = side_deg * std::numbers::pi / 180.0;
  return network;
}
Boundary told_flows(double main, double side) {
  return {12000.0, std::nullopt, {{0.0, 0.0, main}, {0.0, 0.0, side}}};
}

TEST(Jets, GoOnIntoTheStraighterBranch) {
  FlowModel model = with_developed_root();
  model.junctions = JunctionLaw::none;
  const PreparedNetwork network(trunk_with_a_jet(), model);
  const Solution s = solve(network, told_flows(0.7, 0.4));
  ASSERT_EQ(s.start_momentum.size(), 3u);
  const double excess = along(network, s, 0).back().momentum - developed;
  EXPECT_GT(excess, 1.0);
  // What goes the branch's way keeps its speed: the coefficient goes with the ratio of mean speeds.
  const double ratio =
      (1.1 / circle_mm2(1.8)) / (0.7 / circle_mm2(1.5)) * std::cos(15.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(s.start_momentum[1], developed + excess * ratio, 1e-6);
  EXPECT_EQ(s.start_momentum[2], developed);
  // The pressure does not jump: what comes back comes as the jet mixes in the branch.
  EXPECT_NEAR(s.from_pa[1], s.to_pa[0], 1e-9 * s.to_pa[0]);
  EXPECT_NEAR(s.from_pa[2], s.to_pa[0], 1e-9 * s.to_pa[0]);
  EXPECT_GT(s.to_pa[1] + 0.7 * poiseuille_pa_s_ml(40.0, 1.5), s.from_pa[1]);
}

TEST(Jets, AreSplitWhereBranchesTurnAlike) {
  FlowModel model = with_developed_root();
  model.junctions = JunctionLaw::none;
  const auto shares = [&](double side_deg) {
    const PreparedNetwork network(trunk_with_a_jet(side_deg), model);
    const Solution s = solve(network, told_flows(0.6, 0.5));
    const double excess = along(network, s, 0).back().momentum - developed;
    const auto share = [&](std::size_t b, double flow, double radius, double turn_deg) {
      const double ratio = (1.1 / circle_mm2(1.8)) / (flow / circle_mm2(radius)) *
                           std::cos(turn_deg * std::numbers::pi / 180.0);
      return (s.start_momentum[b] - developed) / (excess * ratio);
    };
    return std::array{share(1, 0.6, 1.5, 15.0), share(2, 0.5, 1.2, side_deg)};
  };
  EXPECT_NEAR(shares(15.0)[0], 0.5, 1e-9);
  EXPECT_NEAR(shares(15.0)[1], 0.5, 1e-9);
  EXPECT_NEAR(shares(30.0)[0], 0.8, 1e-9);  // (1 - 15 / 30)^2 = 1 / 4 to the other
  EXPECT_NEAR(shares(30.0)[1], 0.2, 1e-9);
  EXPECT_NEAR(shares(44.99)[1], 0.0, 1e-6);
  EXPECT_EQ(shares(45.0)[1], 0.0);
}

TEST(Jets, DoNotGoIntoAnOccludedBranch) {
  FlowModel model = with_developed_root();
  model.junctions = JunctionLaw::none;
  Network tree = trunk_with_a_jet(30.0);
  tree.branches[1].stations[10].area_mm2 = 0.0;  // the straighter one
  const PreparedNetwork network(tree, model);
  const Solution s = solve(network, told_flows(0.7, 1.0));
  const double excess = along(network, s, 0).back().momentum - developed;
  EXPECT_GT(excess, 0.5);
  const double ratio = circle_mm2(1.2) / circle_mm2(1.8) * std::cos(30.0 * std::numbers::pi / 180.0);
  EXPECT_NEAR(s.start_momentum[2], developed + excess * ratio, 1e-6);
}

TEST(Jets, OfAForkHaveTheExactJacobian) {
  const PreparedNetwork network(trunk_with_a_jet(), {});
  const Boundary boundary{12000.0, std::nullopt, {{4000.0, 650.0, {}}, {6000.0, 650.0, {}}}};
  const std::vector<double> flows = {0.8, 0.5};
  const Residuals at = residuals(network, boundary, 12000.0, flows);
  for (std::size_t j = 0; j < 2; ++j) {
    std::vector<double> more = flows, less = flows;
    more[j] += 1e-6, less[j] -= 1e-6;
    const Residuals up = residuals(network, boundary, 12000.0, more);
    const Residuals down = residuals(network, boundary, 12000.0, less);
    for (std::size_t i = 0; i < 2; ++i) {
      const double slope = (up.pa[i] - down.pa[i]) / 2e-6;
      EXPECT_NEAR(at.jacobian_pa_s_ml[2 * i + j], slope, 1e-4 * std::max(1.0, std::abs(slope))) << i << j;
    }
  }
  EXPECT_LE(solve(network, boundary).residual_pa, 1e-9 * 12000.0);
}

TEST(StenosisFormulas, OfHuoAndKassabLieBetweenTheirLimits) {
  const auto named = [](const StenosisCase& one, const char* name) {
    for (const FormulaDrop& formula : stenosis_formulas(one))
      if (formula.name == name) return formula.pa;
    return -1.0;
  };
  StenosisCase one{3.0, 1.5, 1e-3, 1.0, 1060.0, 3.5};
  const double vessel = circle_mm2(1.5), throat = circle_mm2(0.75);
  const double borda = 0.5 * 1060.0 * std::pow(1.0 / throat - 1.0 / vessel, 2);
  EXPECT_NEAR(named(one, "Huo-Kassab") / borda, 1.0, 0.1);  // no length: a flat jet
  // Longer by a millimetre where the flow has developed: Poiseuille's alone.
  one.length_mm = 400.0;
  const double a = named(one, "Huo-Kassab");
  one.length_mm = 401.0;
  EXPECT_NEAR(named(one, "Huo-Kassab") - a, poiseuille_pa_s_ml(1.0, 0.75),
              1e-6 * poiseuille_pa_s_ml(1.0, 0.75));
  // Beyond friction: the entrance's excess and the developed jet's loss.
  const double dynamic = 0.5 * 1060.0 / (throat * throat);
  const double jet = 1060.0 * (1.0 / throat - 1.0 / vessel) * (1.0 / throat - 1.0 / (3.0 * vessel));
  const double entrance = (a - jet - poiseuille_pa_s_ml(400.0, 0.75)) / dynamic;
  EXPECT_GT(entrance, 0.0);
  EXPECT_LT(entrance, 1.4);
  one.flow_ml_s = 0.0;
  EXPECT_EQ(named(one, "Huo-Kassab"), 0.0);
}

}  // namespace
}  // namespace ostia::hemodynamics
