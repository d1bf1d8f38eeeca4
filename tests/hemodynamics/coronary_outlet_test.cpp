// The bed over the beat: against its steady state and the exact course of a single compliance.

#include "flow_networks.h"

#include "ostia/core/error.h"
#include "ostia/hemodynamics/pulse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace ostia::hemodynamics {
namespace {

using testing::narrowed, testing::vessel_of;

TEST(CoronaryBed, StaysAtItsSteadyState) {
  const CoronaryBed bed = coronary_bed(9000.0, 4e-5, 700.0);
  EXPECT_NEAR(bed.resistance_pa_s_ml(), 9000.0, 1e-9);
  BedState state = steady_state(bed, 0.8);
  for (int i = 0; i < 10; ++i) {
    const Outlet outlet = step_outlet(bed, state, 0.01, 0.0);
    EXPECT_NEAR(outlet.distal_pa + outlet.resistance_pa_s_ml * 0.8, 700.0 + 9000.0 * 0.8, 1e-8);
    state = after_step(bed, state, 0.01, 0.0, 0.8);
  }
  EXPECT_NEAR(state.artery_pa, steady_state(bed, 0.8).artery_pa, 1e-8);
}

TEST(CoronaryBed, FillsAsItsEquationsSay) {
  // Without the artery's compliance and with a flow that is told: one compliance over the vein, whose
  // pressure comes to Pv + Rv Q as exp(-t / (Rv C)).
  CoronaryBed bed{1000.0, 1000.0, 2000.0, 1e-12, 5e-5, 500.0};
  BedState state = steady_state(bed, 0.0);
  const double dt = 1e-4, time = 0.1, flow = 1.2;
  for (int i = 0; i < 1000; ++i) state = after_step(bed, state, dt, 0.0, flow);
  const double exact = 500.0 + 2000.0 * flow * (1.0 - std::exp(-time / (2000.0 * 5e-5)));
  EXPECT_NEAR(state.muscle_pa / exact, 1.0, 1e-3);
}

TEST(CoronaryBed, MuscleThatPressesHoldsTheFlowBack) {
  const CoronaryBed bed = coronary_bed(9000.0, 4e-5, 700.0);
  const BedState state = steady_state(bed, 0.8);
  EXPECT_GT(step_outlet(bed, state, 0.01, 2000.0).distal_pa, step_outlet(bed, state, 0.01, 0.0).distal_pa);
}

TEST(Pulse, PressuresAreTheConditions) {
  const Conditions conditions;
  double mean = 0.0, least = HUGE_VAL, most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double p = aortic_pressure_pa(conditions, i / 1000.0) / pa_of_mmhg;
    mean += p / 1000.0;
    least = std::min(least, p);
    most = std::max(most, p);
    EXPECT_LE(ventricular_pressure_pa(conditions, i / 1000.0), conditions.systolic_mmhg * pa_of_mmhg + 1e-6);
  }
  EXPECT_NEAR(mean, conditions.mean_aortic_mmhg(), 0.2);
  EXPECT_NEAR(least, 80.0, 0.1);
  EXPECT_NEAR(most, 120.0, 0.1);
  const Phases window = wave_free_period(conditions);
  EXPECT_GT(window.from, 0.4);
  EXPECT_LT(window.to, 1.0);
}

TEST(Pulse, OfATreeIsPeriodicAndFlowsInDiastole) {
  Network network;
  network.branches = {vessel_of(60.0, narrowed(1.6, 20.0, 10.0, 0.5))};
  const PreparedNetwork prepared(network, {});
  const Conditions conditions;
  const RestingFlow resting = resting_flow(network, conditions);
  const FlowState rest = flow_state(prepared, conditions, resting, State::rest);
  const Pulse beat = pulse(prepared, conditions, rest, {{0, 45.0}});
  EXPECT_LE(beat.change_pa, 1.0);
  const auto& flow = beat.outlet_flow_ml_s[0];
  ASSERT_EQ(flow.size(), 200u);
  const double systole = std::accumulate(flow.begin(), flow.begin() + 60, 0.0) / 60.0;
  const double diastole = std::accumulate(flow.begin() + 90, flow.begin() + 180, 0.0) / 90.0;
  EXPECT_GT(diastole, 1.3 * systole);
  EXPECT_NEAR(beat.mean_flow_ml_s[0] / rest.solution.flow_ml_s[0], 1.0, 0.05);
  const PulsePlace& place = beat.places[0];
  EXPECT_LT(place.mean_ratio, 1.0);
  // In diastole more flows, and more pressure is lost.
  EXPECT_LT(place.wave_free_ratio, place.mean_ratio);
  PulseOptions wrong;
  wrong.steps = 3;
  EXPECT_THROW(pulse(prepared, conditions, rest, {}, wrong), InvalidInput);
  EXPECT_THROW(pulse(prepared, conditions, rest, {{7, 0.0}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::hemodynamics
