// What flows against what: totals, shares, refusals, and the two states.

#include "flow_networks.h"

#include "ostia/core/error.h"
#include "ostia/hemodynamics/flow_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::hemodynamics {
namespace {

using ::testing::HasSubstr;
using testing::narrowed, testing::tube_of, testing::vessel_of;

Network left_and_right(double least = 1.0) {
  Network network;
  network.branches = {tube_of(10.0, 2.2), vessel_of(60.0, narrowed(1.6, 20.0, 10.0, least), 0),
                      tube_of(50.0, 1.4, 0), tube_of(80.0, 1.8)};
  network.branches[3].name = "RCA";
  return network;
}

TEST(Conditions, MeanPressureIsOfTheCuff) {
  EXPECT_DOUBLE_EQ(Conditions().mean_aortic_mmhg(), 96.0);
}

TEST(Conditions, FlowOfTheCalibreIsVanDerGiessens) {
  const Network network = left_and_right();
  const RestingFlow flow = resting_flow(network, {});
  EXPECT_EQ(flow.source, FlowSource::calibre);
  EXPECT_NEAR(flow.total_ml_s, 1.43e6 * (std::pow(4.4e-3, 2.55) + std::pow(3.6e-3, 2.55)), 1e-9);
  // Of the left tree by d^2.27.
  EXPECT_NEAR(flow.outlets_ml_s[0] / flow.outlets_ml_s[1], std::pow(1.6 / 1.4, 2.27), 1e-9);
  EXPECT_NEAR(flow.outlets_ml_s[2], 1.43e6 * std::pow(3.6e-3, 2.55), 1e-9);
}

TEST(Conditions, FlowOfTheMassGoesBeforeTheCalibre) {
  Conditions conditions;
  conditions.lv_mass_g = 150.0;
  const RestingFlow both = resting_flow(left_and_right(), conditions);
  EXPECT_EQ(both.source, FlowSource::mass);
  EXPECT_NEAR(both.total_ml_s, 150.0 * 0.9 / 60.0, 1e-12);
  Network left = left_and_right();
  left.branches.pop_back();
  const RestingFlow one = resting_flow(left, conditions);
  EXPECT_EQ(one.source, FlowSource::calibre);
  EXPECT_THAT(one.notes.front(), HasSubstr("share"));
  conditions.supplied_share = 0.6;
  EXPECT_NEAR(resting_flow(left, conditions).total_ml_s, 0.6 * 150.0 * 0.9 / 60.0, 1e-12);
  conditions.rest_flow_ml_min = 120.0;
  EXPECT_EQ(resting_flow(left, conditions).source, FlowSource::told);
  EXPECT_NEAR(resting_flow(left, conditions).total_ml_s, 2.0, 1e-12);
}

TEST(Conditions, AnOstialStenosisDoesNotMakeTheFlowSmall) {
  const Branch branch = vessel_of(40.0, narrowed(2.0, 2.0, 4.0, 0.4));
  EXPECT_NEAR(root_diameter_mm(branch), 4.0, 1e-9);
}

TEST(Conditions, AreRefusedBeyondPhysiology) {
  Conditions conditions;
  conditions.systolic_mmhg = 400.0;
  try {
    validate(conditions);
    FAIL() << "400 mmHg are taken";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("systolic_mmhg is 400 mmHg"));
    EXPECT_THAT(error.what(), HasSubstr("between 60 and 260"));
  }
  EXPECT_NO_THROW(validate(conditions, true));
  conditions.systolic_mmhg = 70.0;
  EXPECT_THROW(validate(conditions, true), InvalidInput);
  conditions = {};
  conditions.viscosity_mpa_s = std::nan("");
  EXPECT_THROW(validate(conditions, true), InvalidInput);
  conditions = {};
  conditions.venous_mmhg = 96.0;
  EXPECT_THROW(validate(conditions, true), InvalidInput);
}

TEST(Conditions, ComeBackFromJson) {
  Conditions conditions;
  conditions.systolic_mmhg = 133.0;
  conditions.lv_mass_g = 141.5;
  const Conditions back = conditions_of_json(conditions_json(conditions));
  for (const ConditionInput& input : condition_inputs()) {
    if (input.value)
      EXPECT_EQ(back.*input.value, conditions.*input.value) << input.key;
    else
      EXPECT_EQ(back.*input.optional, conditions.*input.optional) << input.key;
  }
  EXPECT_EQ(conditions_of_json(R"({"venous_mmhg": 7})").venous_mmhg, 7.0);
  EXPECT_THROW(conditions_of_json(R"({"venus_mmhg": 7})"), InvalidInput);
  EXPECT_THROW(conditions_of_json(R"({"venous_mmhg": "seven"})"), InvalidInput);
  EXPECT_THROW(conditions_of_json("[1, 2"), InvalidInput);
}

TEST(Conditions, EveryInputHasRangesAndASource) {
  for (const ConditionInput& input : condition_inputs()) {
    EXPECT_NE(input.value == nullptr, input.optional == nullptr) << input.key;
    EXPECT_FALSE(input.source.empty()) << input.key;
    EXPECT_LE(input.least, input.usual_low) << input.key;
    EXPECT_LT(input.usual_low, input.usual_high) << input.key;
    EXPECT_LE(input.usual_high, input.most) << input.key;
  }
}

TEST(FlowState, AHealthyTreeHasFfrNearOneAndAReserve) {
  const PreparedNetwork network(left_and_right(), {});
  const RestingFlow resting = resting_flow(network.network(), {});
  const FlowState hyper = flow_state(network, {}, resting, State::hyperaemia);
  const FlowState rest = flow_state(network, {}, resting, State::rest);
  EXPECT_TRUE(rest.exhausted.empty());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t outlet = network.outlets()[k];
    EXPECT_NEAR(rest.solution.flow_ml_s[outlet], resting.outlets_ml_s[k], 1e-9);
    EXPECT_GT(hyper.solution.to_pa[outlet] / hyper.solution.inlet_pa, 0.85);
    const double reserve = hyper.solution.flow_ml_s[outlet] / rest.solution.flow_ml_s[outlet];
    EXPECT_GT(reserve, 3.0);
    EXPECT_LT(reserve, 1.0 / 0.24);
  }
}

TEST(FlowState, AStenosisTakesTheReserveBeforeTheRest) {
  const PreparedNetwork tight(left_and_right(0.35), {});
  const RestingFlow resting = resting_flow(tight.network(), {});
  const FlowState hyper = flow_state(tight, {}, resting, State::hyperaemia);
  const FlowState rest = flow_state(tight, {}, resting, State::rest);
  EXPECT_LT(hyper.solution.to_pa[1] / hyper.solution.inlet_pa, 0.8);
  EXPECT_NEAR(rest.solution.flow_ml_s[1], resting.outlets_ml_s[0], 1e-9);
  // Nearly shut: the bed is open as far as it can be, and gets less than it asks for.
  const PreparedNetwork shut(left_and_right(0.08), {});
  const FlowState starved = flow_state(shut, {}, resting, State::rest);
  ASSERT_EQ(starved.exhausted, std::vector<std::size_t>{0});
  EXPECT_LT(starved.solution.flow_ml_s[1], 0.5 * resting.outlets_ml_s[0]);
  EXPECT_GT(starved.solution.to_pa[1], 0.0);
}

TEST(FlowState, BehindATightTrunkNoBedTakesMoreThanItAsksFor) {
  Network network;
  network.branches = {tube_of(10.0, 2.2), tube_of(20.0, 1.5, 0), tube_of(20.0, 1.5, 0)};
  const RestingFlow resting = resting_flow(network, {});
  const Conditions conditions;
  const double all_pa = (conditions.mean_aortic_mmhg() - conditions.venous_mmhg) * pa_of_mmhg;
  // At the flow that is asked for the trunk leaves less than wide open beds need; one branch takes twice what
  // there is, so that much less flows.
  const double trunk = resting.total_ml_s, branch = resting.outlets_ml_s[0];
  network.branches[0].lumped.quadratic_pa_s2_ml2 = 0.8 * all_pa / (trunk * trunk);
  network.branches[1].lumped.quadratic_pa_s2_ml2 = 2.0 * all_pa / (branch * branch);
  const PreparedNetwork tight(network, {});
  const FlowState rest = flow_state(tight, conditions, resting, State::rest);
  EXPECT_EQ(rest.exhausted, std::vector<std::size_t>{0});
  EXPECT_LT(rest.solution.flow_ml_s[1], 0.9 * resting.outlets_ml_s[0]);
  EXPECT_NEAR(rest.solution.flow_ml_s[2], resting.outlets_ml_s[1], 1e-9);
  EXPECT_GE(rest.solution.to_pa[2] - conditions.venous_mmhg * pa_of_mmhg,
            microcirculation(resting, conditions).hyperaemic_pa_s_ml[1] * resting.outlets_ml_s[1]);
}

TEST(Conditions, ARootTooShortForSectionsIsAsWideAsItsBranches) {
  Network network = left_and_right();
  const double whole = resting_flow(network, {}).total_ml_s;
  network.branches[0].stations.clear();
  const RestingFlow flow = resting_flow(network, {});
  EXPECT_GT(flow.outlets_ml_s[0], 0.0);
  EXPECT_LT(flow.total_ml_s, whole);
  EXPECT_GT(flow.total_ml_s, resting_flow({{network.branches[3]}}, {}).total_ml_s);
}

}  // namespace
}  // namespace ostia::hemodynamics
