// svZeroDSolver's steady cases, with the numbers that its own tests hold it to (SimVascular/svZeroDSolver,
// tests/cases and tests/test_solver.py), in its units.

#include "ostia/hemodynamics/coronary_outlet.h"
#include "ostia/hemodynamics/network_solver.h"

#include <gtest/gtest.h>

namespace ostia::hemodynamics {
namespace {

Branch resistance(double linear, double stenosis = 0.0, int parent = -1) {
  Branch branch;
  branch.parent = parent;
  branch.lumped = {linear, stenosis};
  return branch;
}

Boundary flow_of_five(std::vector<Outlet> outlets) {
  return {0.0, 5.0, std::move(outlets)};
}

Solution solved(std::vector<Branch> branches, const Boundary& boundary) {
  return solve(PreparedNetwork({std::move(branches)}, {}), boundary);
}

constexpr double bar = 1e-6;  // relative

TEST(PublishedCases, SteadyFlowIntoAResistance) {  // steadyFlow_R_R
  const Solution s = solved({resistance(100.0)}, flow_of_five({{100.0, 100.0, {}}}));
  EXPECT_NEAR(s.inlet_pa, 1100.0, bar * 1100.0);
  EXPECT_NEAR(s.to_pa[0], 600.0, bar * 600.0);
  EXPECT_NEAR(s.flow_ml_s[0], 5.0, bar * 5.0);
}

TEST(PublishedCases, SteadyFlowAgainstAPressure) {  // steadyFlow_R_steadyPressure
  const Solution s = solved({resistance(100.0)}, flow_of_five({{0.0, 1000.0, {}}}));
  EXPECT_NEAR(s.inlet_pa, 1500.0, bar * 1500.0);
}

TEST(PublishedCases, SteadyFlowThroughAStenosis) {  // steadyFlow_stenosis_R
  const Solution s = solved({resistance(100.0, 100.0)}, flow_of_five({{100.0, 100.0, {}}}));
  EXPECT_NEAR(s.inlet_pa, 3600.0, bar * 3600.0);
  EXPECT_NEAR(s.to_pa[0], 600.0, bar * 600.0);
}

TEST(PublishedCases, SteadyFlowIntoACoronaryBed) {  // steadyFlow_R_coronary
  const CoronaryBed bed{100.0, 100.0, 100.0, 1e-4, 1e-4, 0.0};
  // What a step out of the steady state asks for is what the steady state has.
  const Outlet outlet = step_outlet(bed, steady_state(bed, 5.0), 0.005, 0.0);
  const Solution s = solved({resistance(100.0)}, flow_of_five({outlet}));
  EXPECT_NEAR(s.inlet_pa, 2000.0, bar * 2000.0);
  EXPECT_NEAR(s.to_pa[0], 1500.0, bar * 1500.0);
}

TEST(PublishedCases, SteadyFlowThroughABifurcation) {  // steadyFlow_bifurcationR_R1
  const Solution s = solved({resistance(100.0), resistance(100.0, 0.0, 0), resistance(100.0, 0.0, 0)},
                            flow_of_five({{100.0, 100.0, {}}, {100.0, 100.0, {}}}));
  EXPECT_NEAR(s.inlet_pa, 1100.0, bar * 1100.0);
  EXPECT_NEAR(s.to_pa[0], 600.0, bar * 600.0);
  for (const std::size_t daughter : {1u, 2u}) {
    EXPECT_NEAR(s.to_pa[daughter], 350.0, bar * 350.0);
    EXPECT_NEAR(s.flow_ml_s[daughter], 2.5, bar * 2.5);
  }
}

TEST(PublishedCases, SteadyFlowThroughAnUnevenBifurcation) {  // steadyFlow_bifurcationR_R2
  const Solution s = solved({resistance(300.0), resistance(400.0, 0.0, 0), resistance(500.0, 0.0, 0)},
                            flow_of_five({{100.0, 50.0, {}}, {1000.0, 200.0, {}}}));
  EXPECT_NEAR(s.inlet_pa, 3462.5, bar * 3462.5);
  EXPECT_NEAR(s.to_pa[0], 1962.5, bar * 1962.5);
  EXPECT_NEAR(s.to_pa[1], 432.5, bar * 432.5);
  EXPECT_NEAR(s.to_pa[2], 1375.0, bar * 1375.0);
  EXPECT_NEAR(s.flow_ml_s[1], 3.825, bar * 3.825);
  EXPECT_NEAR(s.flow_ml_s[2], 1.175, bar * 1.175);
}

TEST(PublishedCases, PulsatileFlowIntoACoronaryBedAtItsBeginning) {  // pulsatileFlow_R_coronary
  const CoronaryBed bed{100.0, 100.0, 100.0, 1e-4, 1e-4, 0.0};
  Boundary boundary{0.0, 2.2, {step_outlet(bed, steady_state(bed, 2.2), 0.005, 0.0)}};
  const Solution s = solved({resistance(100.0)}, boundary);
  EXPECT_NEAR(s.inlet_pa, 880.0, bar * 880.0);
  EXPECT_NEAR(s.to_pa[0], 660.0, bar * 660.0);
}

}  // namespace
}  // namespace ostia::hemodynamics
