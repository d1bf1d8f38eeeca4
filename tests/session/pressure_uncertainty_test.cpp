// How sure a case's pressures are: the walls' spread by the image, and what is written.

#include "report_cases.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/session/pressure_report.h"
#include "ostia/session/pressure_wall_spread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

PressureReportOptions uncertain_options(int samples = 64) {
  PressureReportOptions options;
  options.uncertainty.emplace();
  options.uncertainty->samples = samples;
  return options;
}

PressureTree walls_of(const lumen::LumenModel& model) {
  return pressure_tree(model, solved_surfaces(model, core::no_task()));
}

/// Noise that depends on the voxel alone.
imaging::ImageVolume noisy(imaging::ImageVolume image, double hu) {
  std::uint32_t state = 1;
  for (std::int16_t& voxel : image.voxels) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      state = state * 1664525u + 1013904223u;
      sum += static_cast<double>(state >> 8) / 16777216.0 - 0.5;
    }
    voxel = static_cast<std::int16_t>(std::lround(voxel + hu * sum * std::sqrt(3.0)));
  }
  return image;
}

TEST(PressureUncertainty, TheWallsSpreadIsThatOfTheImagesEdges) {
  const lumen::LumenModel model = narrowed_tube("LAD", 40.0, 1.5, 20.0, 0.8);
  const PressureTree tree = walls_of(model);
  const auto surfaces = solved_surfaces(model, core::no_task());
  const auto spread_at = [&](double noise_hu) {
    const auto spread =
        wall_spread_of_image(tree, model, surfaces, noisy(walled_image(1.5, 1.9, 60.0), noise_hu));
    EXPECT_EQ(spread.station_sd_mm.size(), tree.network.branches.size());
    EXPECT_EQ(spread.station_sd_mm[0].size(), tree.network.branches[0].stations.size());
    EXPECT_THAT(spread.source, HasSubstr("noise of"));
    return spread.station_sd_mm[0];
  };
  const std::vector<double> quiet = spread_at(15.0), loud = spread_at(150.0);
  for (std::size_t i = 0; i < quiet.size(); ++i) {
    EXPECT_GT(quiet[i], 0.002);
    EXPECT_LE(quiet[i], 0.5);
  }
  const std::size_t away = quiet.size() / 6;
  EXPECT_LT(quiet[away], 0.06);
  EXPECT_GT(loud[away], 1.2 * quiet[away]);
}

TEST(PressureUncertainty, IsReadAtTheLesionAndWritten) {
  const lumen::LumenModel model = narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.75);
  const PressureReport report = make_pressure_report(walls_of(model), uncertain_options());
  ASSERT_TRUE(report.uncertainty.has_value());
  ASSERT_EQ(report.uncertainty->lesions.size(), 1u);
  const auto& of = report.uncertainty->lesions[0].ratio;
  const double nominal = report.under_hyperaemia.lesions[0].behind;
  EXPECT_LT(of.low, nominal);
  EXPECT_GT(of.high, nominal);
  EXPECT_LT(of.low, of.median);
  EXPECT_LT(of.median, of.high);
  EXPECT_GE(of.probability, 0.0);
  EXPECT_LE(of.probability, 1.0);

  const auto folder = ostia::testing::temporary_folder("pressure-uncertainty") / "out";
  write_pressure_report(folder, report, {"ffr", {}, "{}"}, 0.1);
  const Json result = Json::parse(core::read_file(folder / "ffr.json"));
  const Json& uncertainty = result.at("uncertainty");
  EXPECT_EQ(uncertainty.at("lesions").at(0).at("ffr").at("median"), of.median);
  EXPECT_EQ(uncertainty.at("lesions").at(0).at("sobol").size(), hemodynamics::input_groups);
  EXPECT_EQ(uncertainty.at("settings").at("samples"), 64);
  for (const char* file : {"stations.csv", "lesions.csv", "outlets.csv"})
    EXPECT_THAT(core::read_file(folder / file), HasSubstr("ffr_probability")) << file;
  EXPECT_THAT(core::read_file(folder / "sobol.csv"), HasSubstr("lesion,S1,wall,"));
  const std::string lines = core::read_file(folder / "lines.vtp");
  for (const char* name : {"FFRMedian", "FFRLow", "FFRHigh", "FFRProbability"})
    EXPECT_THAT(lines, HasSubstr("\"" + std::string(name) + "\"")) << name;
  for (const auto& station : report.uncertainty->stations[0]) EXPECT_LE(station.low, station.high);

  // What conditions.json says of the spreads can be given again.
  const std::string conditions = core::read_file(folder / "conditions.json");
  const auto again = hemodynamics::uncertainty_of_json(conditions, {});
  EXPECT_EQ(again.samples, 64);
  EXPECT_EQ(again.spreads.size(), report.uncertainty->spreads.size());
  EXPECT_EQ(hemodynamics::conditions_of_json(conditions).systolic_mmhg, 120.0);
}

TEST(PressureUncertainty, IsNotWrittenWhereItIsNotAskedFor) {
  const PressureReport report =
      make_pressure_report(pressure_tree(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.75).tree), {});
  EXPECT_FALSE(report.uncertainty.has_value());
  EXPECT_FALSE(Json::parse(pressure_json(report)).contains("uncertainty"));
  const auto folder = ostia::testing::temporary_folder("pressure-certain") / "out";
  write_pressure_report(folder, report, {"ffr", {}, "{}"}, 0.1);
  EXPECT_THAT(core::read_file(folder / "stations.csv"), Not(HasSubstr("ffr_median")));
  EXPECT_FALSE(std::filesystem::exists(folder / "sobol.csv"));
}

TEST(PressureUncertainty, OfAnOcclusionIsNull) {
  const PressureReport report = make_pressure_report(walls_of(shut_tube()), uncertain_options(16));
  const Json result = Json::parse(pressure_json(report));
  EXPECT_TRUE(result["uncertainty"]["outlets"][0]["ffr"].is_null());
  EXPECT_TRUE(result["uncertainty"]["outlets"][0]["sobol"].is_null());
}

TEST(PressureUncertainty, AnEditLeavesItBehind) {
  PressureReportOptions options = uncertain_options(16);
  const PressureReport report =
      make_pressure_report(pressure_tree(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.75).tree), options);
  EXPECT_FALSE(with_options(report, options).uncertainty.has_value());
  options.uncertainty->samples = 17;
  EXPECT_THROW(with_options(report, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::session::testing
