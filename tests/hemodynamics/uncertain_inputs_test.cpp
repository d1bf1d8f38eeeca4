// The spreads of inputs: as JSON and back, one draw of them, and what is refused.

#include "uncertain_inputs.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::hemodynamics {
namespace {

using ::testing::HasSubstr;

TEST(UncertainInputs, EveryInputHasAPlausibleSpreadAndASource) {
  for (const FlowSource source : {FlowSource::told, FlowSource::mass, FlowSource::calibre})
    for (const InputSpread& one : spreads_of(source)) {
      EXPECT_GT(one.sd, 0.0) << one.key;
      EXPECT_GT(one.source.size(), 5u) << one.key;
      EXPECT_EQ(group_of(one.key), one.group) << one.key;
    }
  EXPECT_LT(spreads_of(FlowSource::told)[4].sd, spreads_of(FlowSource::mass)[4].sd);
  EXPECT_LT(spreads_of(FlowSource::mass)[4].sd, spreads_of(FlowSource::calibre)[4].sd);
}

TEST(UncertainInputs, ADrawIsTheToldValueMovedByItsSpread) {
  const Conditions told;
  const std::vector<InputSpread> spreads = spreads_of(FlowSource::calibre);
  std::vector<double> normal(spreads.size(), 0.0);
  const DrawnInputs none = drawn_inputs(told, spreads, normal);
  EXPECT_EQ(conditions_json(none.conditions), conditions_json(told));
  EXPECT_EQ(none.flow_factor, 1.0);
  const auto drawn = [&](std::string_view key) {
    normal.assign(spreads.size(), 0.0);
    for (std::size_t k = 0; k < spreads.size(); ++k) normal[k] = spreads[k].key == key ? 1.0 : 0.0;
    return drawn_inputs(told, spreads, normal);
  };
  EXPECT_NEAR(drawn("systolic_mmhg").conditions.systolic_mmhg, 128.0, 1e-12);
  EXPECT_NEAR(drawn("hyperaemic_resistance").conditions.hyperaemic_resistance, 0.24 * std::exp(0.17), 1e-12);
  EXPECT_NEAR(drawn("rest_flow").flow_factor, std::exp(0.35), 1e-12);
  EXPECT_EQ(conditions_json(drawn("rest_flow").conditions), conditions_json(told));
}

/// However far a draw goes, it is physiology, in order.
TEST(UncertainInputs, ADrawStaysWithinPhysiology) {
  const std::vector<InputSpread> spreads = spreads_of(FlowSource::mass);
  for (const double z : {-60.0, -8.0, 8.0, 60.0})
    for (std::size_t k = 0; k < spreads.size(); ++k) {
      std::vector<double> normal(spreads.size(), 0.0);
      normal[k] = z;
      EXPECT_NO_THROW(validate(drawn_inputs({}, spreads, normal).conditions)) << spreads[k].key << z;
    }
  const std::vector<InputSpread> wide = {{"rest_flow", InputGroup::flow, SpreadLaw::normal, 0.5, "told"}};
  EXPECT_GT(drawn_inputs({}, wide, std::vector<double>{-8.0}).flow_factor, 0.0) << "no flow runs back";
}

TEST(UncertainInputs, ComesBackFromItsJson) {
  UncertaintyOptions options;
  options.samples = 128;
  options.seed = 9;
  options.spreads = spreads_of(FlowSource::mass);
  options.wall.radius_sd_mm = 0.2;
  options.wall.source = "told";
  const UncertaintyOptions back =
      uncertainty_of_json("{\"uncertainty\": " + uncertainty_json(options) + "}", {});
  EXPECT_EQ(uncertainty_json(back), uncertainty_json(options));
  EXPECT_EQ(back.seed, 9u);
  // Spreads by an image stay with the image: neither they nor their source come back.
  options.wall.station_sd_mm = {{0.02, 0.03, 0.05}};
  options.wall.source = "edges";
  const std::string of_image = uncertainty_json(options);
  EXPECT_THAT(of_image, HasSubstr("\"median_mm\": 0.03"));
  const UncertaintyOptions without = uncertainty_of_json(of_image, {});
  EXPECT_TRUE(without.wall.station_sd_mm.empty());
  EXPECT_EQ(without.wall.source, WallSpread().source);
  EXPECT_EQ(without.wall.radius_sd_mm, 0.2);
  const UncertaintyOptions one = uncertainty_of_json(R"({"inputs": {"systolic_mmhg": 5}})", {});
  ASSERT_EQ(one.spreads.size(), 1u);
  EXPECT_EQ(one.spreads[0].sd, 5.0);
  const auto all = spreads_of(FlowSource::calibre, one.spreads);
  EXPECT_EQ(all.size(), spreads_of(FlowSource::calibre).size());
  EXPECT_EQ(all[0].sd, 5.0);
  EXPECT_EQ(all[0].source, "told");
  // A conditions.json without it changes nothing, and the conditions themselves are read past it.
  EXPECT_EQ(uncertainty_of_json(conditions_json({}), options).samples, 128);
  EXPECT_EQ(conditions_of_json(R"({"venous_mmhg": 8, "uncertainty": {}})").venous_mmhg, 8.0);
}

TEST(UncertainInputs, RefusesInOneSentence) {
  const auto refused = [](const UncertaintyOptions& options, const char* says) {
    try {
      validate(options);
      ADD_FAILURE() << says;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(says));
    }
  };
  UncertaintyOptions options;
  options.samples = 15;
  refused(options, "16 to 10000");
  options = {};
  options.wall.radius_sd_mm = std::nan("");
  refused(options, "spread of a wall");
  options = {};
  options.wall.common_share = 1.5;
  refused(options, "have in common");
  options = {};
  options.spreads = {{"heart_rate_bpm", InputGroup::pressure, SpreadLaw::normal, 5.0, ""}};
  refused(options, "heart_rate_bpm is no input that FFR depends on");
  options.spreads = {{"systolic_mmhg", InputGroup::pressure, SpreadLaw::normal, -5.0, ""}};
  refused(options, "spread of systolic_mmhg");
  const auto no_json = [](const char* text, const char* says) {
    try {
      uncertainty_of_json(text, {});
      ADD_FAILURE() << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(says));
    }
  };
  no_json("{", "no JSON");
  no_json("[]", "no JSON object");
  no_json(R"({"inputs": {"sistolic": 5}})", "sistolic");
  no_json(R"({"inputs": {"systolic_mmhg": "much"}})", "systolic_mmhg");
  no_json(R"({"inputs": {"systolic_mmhg": {"sd": 5, "law": "flat"}}})", "normal or lognormal");
  no_json(R"({"inputs": {"systolic_mmhg": {"sd": 5, "law": 7}}})", "another kind");
  no_json(R"({"uncertainty": {"trees": 5}})", "trees");
  no_json(R"({"uncertainty": {"samples": 100.5}})", "samples is no whole number");
  no_json(R"({"uncertainty": {"samples": 1e300}})", "samples is no whole number");
  no_json(R"({"wall": {"sd": 5}})", "sd");
}

}  // namespace
}  // namespace ostia::hemodynamics
