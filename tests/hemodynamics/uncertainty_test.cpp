// How sure pressures are: a tube whose quantiles are known in closed form, what is certain, what comes from
// one input alone.

#include "ostia/hemodynamics/uncertainty.h"

#include "flow_networks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/quasi_random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::hemodynamics {
namespace {

using testing::friction_alone, testing::narrowed, testing::poiseuille_pa_s_ml, testing::tube_of,
    testing::vessel_of;

Conditions told_flow(double ml_min = 60.0) {
  Conditions conditions;
  conditions.rest_flow_ml_min = ml_min;
  return conditions;
}

/// Nothing is uncertain but what is set afterwards.
UncertaintyOptions certain(int samples = 200) {
  UncertaintyOptions options;
  options.samples = samples;
  options.spreads = spreads_of(FlowSource::told);
  for (InputSpread& spread : options.spreads) spread.sd = 0.0;
  options.wall.radius_sd_mm = 0.0;
  return options;
}

UncertaintyOptions drawn(int samples, std::uint64_t seed = 1) {
  UncertaintyOptions options;
  options.samples = samples;
  options.seed = seed;
  return options;
}

void set_sd(UncertaintyOptions& options, std::string_view key, double sd) {
  for (InputSpread& spread : options.spreads)
    if (spread.key == key) spread.sd = sd;
}

Network narrowed_tree() {
  Network network;
  network.branches = {tube_of(20.0, 2.0), vessel_of(60.0, narrowed(1.6, 15.0, 10.0, 0.5), 0),
                      tube_of(30.0, 1.3, 0)};
  network.branches[1].angle_rad = -0.3;
  network.branches[2].angle_rad = 0.7;
  for (std::size_t b = 0; b < 3; ++b) network.branches[b].vessel = static_cast<std::int32_t>(b);
  return network;
}
const LesionPlace lesion{"S1", {1, 10.0}, {1, 15.0}, {1, 20.0}};

/// A tube with a bed: FFR = 1 - R (pa - pv) / ((R + bed) pa), R = 8 mu L / (pi r^4), ln r normal.
struct Tube {
  double length = 40.0, radius = 0.8, sd = 0.08;
  Conditions conditions = told_flow();
  double ffr(double z) const {
    const double pa = conditions.mean_aortic_mmhg() * pa_of_mmhg, pv = conditions.venous_mmhg * pa_of_mmhg;
    const double bed = (pa - pv) / (*conditions.rest_flow_ml_min / 60.0) * conditions.hyperaemic_resistance;
    const double tube =
        poiseuille_pa_s_ml(length, radius * std::exp(z * sd / radius), conditions.viscosity_mpa_s);
    return 1.0 - tube * (pa - pv) / ((tube + bed) * pa);
  }
  PressureUncertainty found(int samples) const {
    Network network;
    network.branches = {tube_of(length, radius)};
    UncertaintyOptions options = certain(samples);
    options.wall.radius_sd_mm = sd;
    options.wall.common_share = 1.0;
    return pressure_uncertainty(network, conditions, {}, friction_alone(), {}, options);
  }
};

TEST(Uncertainty, MeetsTheQuantilesOfATubeOfLognormalRadius) {
  const Tube tube;
  const PressureUncertainty found = tube.found(4000);
  ASSERT_EQ(found.outlets.size(), 1u);
  const Distribution& end = found.outlets[0].ratio;
  EXPECT_NEAR(end.median, tube.ffr(0.0), 5e-4);
  EXPECT_NEAR(end.low, tube.ffr(-1.959964), 3e-3);
  EXPECT_NEAR(end.high, tube.ffr(1.959964), 1e-3);
  // FFR is 0.80 at this z.
  double low = -5.0, high = 5.0;
  for (int i = 0; i < 60; ++i) (tube.ffr(0.5 * (low + high)) < 0.8 ? low : high) = 0.5 * (low + high);
  EXPECT_NEAR(end.probability, 0.5 * std::erfc(-low / std::numbers::sqrt2), 2e-3);
  EXPECT_NEAR(found.outlets[0].indices.first[0], 1.0, 0.01);
  EXPECT_NEAR(found.outlets[0].indices.total[0], 1.0, 0.01);
  for (std::size_t g = 1; g < input_groups; ++g) EXPECT_EQ(found.outlets[0].indices.total[g], 0.0);
  EXPECT_EQ(found.failed, 0);
  // Along the tube it widens from nothing.
  EXPECT_NEAR(found.stations[0].front().sd, 0.0, 1e-9);
  EXPECT_GT(found.stations[0].back().sd, found.stations[0][20].sd);
}

/// Walls that err here and there err less in the mean than walls that err alike.
TEST(Uncertainty, LocalErrorsOfAWallCancelAlongIt) {
  Network network;
  network.branches = {tube_of(60.0, 0.9)};
  UncertaintyOptions options = certain(600);
  options.wall.radius_sd_mm = 0.08;
  options.wall.common_share = 1.0;
  const auto alike = pressure_uncertainty(network, told_flow(), {}, friction_alone(), {}, options);
  options.wall.common_share = 0.0;
  options.wall.correlation_mm = 4.0;
  const auto apart = pressure_uncertainty(network, told_flow(), {}, friction_alone(), {}, options);
  // Of the mean over 60 mm: the kernel's integral is 4 / sqrt(3) times its length of the 60 mm.
  const double expected = std::sqrt(4.0 / std::sqrt(3.0) * 4.0 / 60.0);
  EXPECT_NEAR(apart.outlets[0].ratio.sd / alike.outlets[0].ratio.sd, expected, 0.08);
}

TEST(Uncertainty, IsNoneWhereNothingIsUncertain) {
  const Network network = narrowed_tree();
  const Conditions conditions = told_flow(120.0);
  const PreparedNetwork prepared(network, flow_model_of(conditions));
  const RestingFlow resting = resting_flow(network, conditions);
  const TreeReadings nominal =
      read_tree(prepared, flow_state(prepared, conditions, resting, State::hyperaemia), {lesion});
  const double ffr = nominal.lesions[0].behind;
  ReadingOptions reading;
  for (const double threshold : {ffr - 1e-6, ffr + 1e-6}) {
    reading.threshold = threshold;
    const auto found = pressure_uncertainty(network, conditions, {lesion}, {}, reading, certain(16));
    const Distribution& of = found.lesions[0].ratio;
    EXPECT_NEAR(of.median, ffr, 1e-9);
    EXPECT_NEAR(of.high - of.low, 0.0, 1e-9);
    EXPECT_EQ(of.probability, threshold < ffr ? 0.0 : 1.0);
    EXPECT_NEAR(found.lesion_falls[0].median, nominal.lesions[0].delta(), 1e-9);
    EXPECT_EQ(found.trees, 16);
    for (const double index : found.lesions[0].indices.total) EXPECT_EQ(index, 0.0);
  }
}

TEST(Uncertainty, ComesFromTheOneInputThatIsUncertain) {
  const std::pair<std::string_view, InputGroup> inputs[] = {{"systolic_mmhg", InputGroup::pressure},
                                                            {"rest_flow", InputGroup::flow},
                                                            {"hyperaemic_resistance", InputGroup::hyperaemia},
                                                            {"split_exponent", InputGroup::split},
                                                            {"viscosity_mpa_s", InputGroup::blood}};
  for (const auto& [key, group] : inputs) {
    UncertaintyOptions options = certain(400);
    set_sd(options, key, key == "systolic_mmhg" ? 10.0 : 0.15);
    const auto found = pressure_uncertainty(narrowed_tree(), told_flow(150.0), {lesion}, {}, {}, options);
    for (std::size_t g = 0; g < input_groups; ++g)
      EXPECT_NEAR(found.lesions[0].indices.total[g], g == static_cast<std::size_t>(group) ? 1.0 : 0.0, 0.1)
          << key << " " << name_of(static_cast<InputGroup>(g));
    EXPECT_GT(found.lesions[0].ratio.sd, 0.0) << key;
    EXPECT_GT(found.outlet_flow_ml_s[0].median, 0.0);
  }
}

TEST(Uncertainty, MoreFlowIsLessPressureInEveryQuantile) {
  const UncertaintyOptions options = drawn(200);
  const auto little = pressure_uncertainty(narrowed_tree(), told_flow(90.0), {lesion}, {}, {}, options);
  const auto much = pressure_uncertainty(narrowed_tree(), told_flow(180.0), {lesion}, {}, {}, options);
  EXPECT_LT(much.lesions[0].ratio.median, little.lesions[0].ratio.median);
  EXPECT_LT(much.lesions[0].ratio.low, little.lesions[0].ratio.low);
  EXPECT_LT(much.lesions[0].ratio.high, little.lesions[0].ratio.high);
  EXPECT_GE(much.lesions[0].ratio.probability, little.lesions[0].ratio.probability);
  double total = 0.0;
  for (const double index : much.lesions[0].indices.total) total += index;
  EXPECT_GT(total, 0.9);  // total shares cover the whole
  EXPECT_EQ(much.trees, 200 + 6 * 100);
}

TEST(Uncertainty, TheIndicesAskForMoreTreesAndChangeNoNumber) {
  UncertaintyOptions options = drawn(64);
  const auto with = pressure_uncertainty(narrowed_tree(), told_flow(), {lesion}, {}, {}, options);
  options.indices = false;
  const auto without = pressure_uncertainty(narrowed_tree(), told_flow(), {lesion}, {}, {}, options);
  EXPECT_EQ(with.lesions[0].ratio.median, without.lesions[0].ratio.median);
  EXPECT_EQ(with.stations[1][40].low, without.stations[1][40].low);
  EXPECT_EQ(without.trees, 64);
}

TEST(Uncertainty, IsTheSameForAnyNumberOfThreads) {
  const UncertaintyOptions options = drawn(64);
  std::vector<PressureUncertainty> all;
  for (const int threads : {1, 2, 5}) {
    core::set_max_threads(threads);
    all.push_back(pressure_uncertainty(narrowed_tree(), told_flow(), {lesion}, {}, {}, options));
  }
  core::set_max_threads(0);
  for (const PressureUncertainty& one : all) {
    EXPECT_EQ(one.lesions[0].ratio.median, all[0].lesions[0].ratio.median);
    EXPECT_EQ(one.lesions[0].ratio.mean, all[0].lesions[0].ratio.mean);
    EXPECT_EQ(one.lesions[0].indices.first, all[0].lesions[0].indices.first);
    EXPECT_EQ(one.outlets[1].ratio.low, all[0].outlets[1].ratio.low);
    for (std::size_t i = 0; i < one.stations[1].size(); ++i)
      EXPECT_EQ(one.stations[1][i].sd, all[0].stations[1][i].sd);
  }
  UncertaintyOptions other = options;
  other.seed = 2;
  EXPECT_NE(pressure_uncertainty(narrowed_tree(), told_flow(), {lesion}, {}, {}, other).lesions[0].ratio.mean,
            all[0].lesions[0].ratio.mean);
}

TEST(Uncertainty, BehindAnOcclusionNothingIsKnown) {
  Network network = narrowed_tree();
  network.branches[1].stations[30].area_mm2 = 0.0;
  const auto found = pressure_uncertainty(network, told_flow(), {lesion}, {}, {}, drawn(32));
  EXPECT_FALSE(found.lesions[0].ratio.known);
  EXPECT_FALSE(found.outlets[0].ratio.known);
  EXPECT_FALSE(found.stations[1][10].known);
  EXPECT_TRUE(found.outlets[1].ratio.known);
  EXPECT_LT(found.outlets[1].ratio.high, 1.0);
}

TEST(Uncertainty, AThroatLikeAHairSettles) {
  Network network = narrowed_tree();
  network.branches[1] = vessel_of(60.0, narrowed(1.6, 15.0, 10.0, 0.03), 0);
  network.branches[1].vessel = 1;
  UncertaintyOptions options = drawn(200);
  options.wall.radius_sd_mm = 0.3;
  const auto found = pressure_uncertainty(network, told_flow(150.0), {lesion}, {}, {}, options);
  EXPECT_EQ(found.failed, 0);
  EXPECT_TRUE(std::isfinite(found.lesions[0].ratio.low));
  EXPECT_GE(found.lesions[0].ratio.low, 0.0);
  EXPECT_EQ(found.lesions[0].ratio.probability, 1.0);
}

TEST(Uncertainty, ASpreadOfStationsIsOfThese) {
  const Network network = narrowed_tree();
  UncertaintyOptions options = certain(400);
  options.wall.station_sd_mm.resize(3);
  options.wall.station_sd_mm[1].assign(network.branches[1].stations.size(), 0.0);
  for (std::size_t i = 20; i < 41; ++i) options.wall.station_sd_mm[1][i] = 0.1;  // about the throat
  const auto found = pressure_uncertainty(network, told_flow(150.0), {lesion}, {}, {}, options);
  EXPECT_NEAR(found.stations[0].back().sd, 0.0, 0.01);
  EXPECT_GT(found.lesions[0].ratio.sd, 0.01);
  EXPECT_NEAR(found.lesions[0].indices.total[0], 1.0, 0.1);
  options.wall.station_sd_mm[1].pop_back();
  EXPECT_THROW(pressure_uncertainty(network, told_flow(), {lesion}, {}, {}, options), InvalidInput);
  options.wall.station_sd_mm.pop_back();
  EXPECT_THROW(pressure_uncertainty(network, told_flow(), {lesion}, {}, {}, options), InvalidInput);
}

TEST(Uncertainty, StopsWhenItIsCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(pressure_uncertainty(narrowed_tree(), told_flow(), {lesion}, {}, {}, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::hemodynamics
