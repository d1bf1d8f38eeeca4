#include "ostia/experiments/certainty.h"

#include "schema_rules.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/phantom/noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;

TEST(LogisticFit, FindsTheWeightsThatMadeTheOutcomes) {
  std::vector<std::vector<double>> looks;
  std::vector<bool> right;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double a = phantom::normal(1, i), b = 5.0 + 3.0 * phantom::normal(2, i);
    const double logit = 0.5 + 1.5 * a - 0.4 * (b - 5.0);
    looks.push_back({a, b, 7.0});  // the third is always the same
    right.push_back(phantom::uniform(3, i) < 1.0 / (1.0 + std::exp(-logit)));
  }
  const LogisticWeights fitted = fitted_logistic(looks, right);
  ASSERT_EQ(fitted.weights.size(), 3U);
  EXPECT_NEAR(fitted.weights[0], 1.5, 0.08);
  EXPECT_NEAR(fitted.weights[1], -0.4, 0.03);
  EXPECT_NEAR(fitted.constant + 5.0 * fitted.weights[1] + 7.0 * fitted.weights[2], 0.5, 0.08);
}

TEST(LogisticFit, ExistsWhereALookDecidesAndNeedsBothOutcomes) {
  const LogisticWeights fitted = fitted_logistic({{0.0}, {1.0}, {2.0}, {3.0}}, {false, false, true, true});
  EXPECT_GT(fitted.weights[0], 0.05);
  EXPECT_LT(fitted.weights[0], 10.0);
  EXPECT_NEAR(fitted.constant + 1.5 * fitted.weights[0], 0.0, 1e-6);
  EXPECT_THROW(fitted_logistic({{0.0}, {1.0}}, {true, true}), InvalidInput);
  EXPECT_THROW(fitted_logistic({{0.0}, {1.0}}, {true}), InvalidInput);
  EXPECT_THROW(fitted_logistic({{0.0}, {1.0, 2.0}}, {true, false}), InvalidInput);
}

geometry::VesselTree straight(const std::vector<Vec3>& from, const Vec3& way, double radius_mm) {
  geometry::VesselTree tree;
  for (std::size_t v = 0; v < from.size(); ++v) {
    const auto id = static_cast<std::int32_t>(v);
    geometry::Centerline axis;
    for (int i = 0; i <= 80; ++i) {
      axis.points.push_back(from[v] + way * i / 80.0);
      axis.radius.push_back(radius_mm);
    }
    geometry::complete(axis);
    tree.nodes.push_back({2 * id, axis.points.front()});
    tree.nodes.push_back({2 * id + 1, axis.points.back()});
    tree.segments.push_back({id, 2 * id, 2 * id + 1, axis});
    tree.vessels.push_back({id, "V" + std::to_string(id + 1), {id}});
  }
  return tree;
}

/// Pieces of ten millimetres, of one probability.
coronary::VesselCertainty said(std::int32_t vessel, double probability) {
  coronary::VesselCertainty one;
  one.vessel = vessel;
  one.probability = probability;
  for (int k = 0; k < 4; ++k) {
    one.pieces.emplace_back();
    one.pieces.back().from_mm = 10.0 * k, one.pieces.back().to_mm = 10.0 * (k + 1);
    one.pieces.back().probability = probability;
  }
  return one;
}

CertaintyRuns judged_by_hand() {
  ExtractionTruth truth;
  truth.case_name = "made";
  truth.tree = straight({{0, 0, 0}, {30, 0, 0}}, {0, 0, 40}, 1.0);
  coronary::Extraction found;
  // One in the lumen, one beside it; one leaves it after 40 mm * 1 / 1.6 = 25 mm.
  found.vessels.tree = straight({{0.5, 0, 0}, {28.5, 0, 0}}, {0, 0, 40}, 1.0);
  const geometry::VesselTree leaving = straight({{30, 0, 0}}, {1.6, 0, 40}, 1.0);
  found.vessels.tree.nodes.push_back({4, leaving.nodes[0].position});
  found.vessels.tree.nodes.push_back({5, leaving.nodes[1].position});
  found.vessels.tree.segments.push_back({2, 4, 5, leaving.segments[0].axis});
  found.vessels.tree.vessels.push_back({2, "V3", {2}});
  found.certainty = {said(0, 0.9), said(1, 0.2), said(2, 0.6)};
  CertaintyRuns runs;
  runs.searches = 1;
  judge(found, truth, SearchKind::usual, runs);
  return runs;
}

TEST(CertaintyExperiment, JudgesByTheTrueLumen) {
  const CertaintyRuns runs = judged_by_hand();
  ASSERT_EQ(runs.vessels.size(), 3U);
  ASSERT_EQ(runs.pieces.size(), 12U);
  EXPECT_EQ(runs.first_piece, (std::vector<std::size_t>{0, 4, 8}));
  EXPECT_EQ(runs.vessels[0].within, 1.0);
  EXPECT_TRUE(runs.vessels[0].right());
  EXPECT_EQ(runs.vessels[1].within, 0.0);
  EXPECT_NEAR(runs.vessels[2].within, 25.0 / 40.0, 0.02);
  EXPECT_FALSE(runs.vessels[2].right());
  EXPECT_TRUE(runs.pieces[9].right());
  EXPECT_NEAR(runs.pieces[10].within, 0.5, 0.06);
  EXPECT_FALSE(runs.pieces[10].right());
  const evaluation::Calibration sum = calibration_of(forecasts_of(runs.vessels));
  EXPECT_NEAR(sum.expected_error, (0.1 + 0.2 + 0.6) / 3.0, 1e-9);
}

TEST(CertaintyExperiment, ScansAreDrawnFromTheSeedAndShareACleanImage) {
  const std::vector<Variation> once = drawn_variations(7, 3), again = drawn_variations(7, 3);
  ASSERT_EQ(once.size(), 12U);
  std::set<std::string> whats;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].what, again[i].what);
    EXPECT_EQ(once[i].noise_hu, again[i].noise_hu);
    whats.insert(once[i].what);
    if (i % 4 == 0) continue;
    EXPECT_EQ(once[i].what, once[i - 1].what);
    EXPECT_GT(once[i].noise_hu, once[i - 1].noise_hu);
  }
  EXPECT_EQ(whats.size(), 3U);
  EXPECT_NE(drawn_variations(8, 1)[0].what, once[0].what);
  EXPECT_EQ(drawn_variations(7, 1)[3].noise_hu, once[3].noise_hu) << "whatever the number of scans";
}

TEST(CertaintyExperiment, LeavesTablesAPictureAndWhatTheSchemaSays) {
  const CertaintyRuns runs = judged_by_hand();
  const auto folder = ostia::testing::temporary_folder("certainty");
  write_certainty_report(folder, runs);
  EXPECT_TRUE(std::filesystem::exists(folder / "reliability.png"));
  EXPECT_THAT(core::read_file(folder / "pieces.csv"), HasSubstr("probability,brightness,darkest,edges"));
  EXPECT_THAT(core::read_file(folder / "vessels.csv"), HasSubstr("made,usual,V3,0.00,40.00,0.6"));
  EXPECT_THAT(core::read_file(folder / "certainty_weights.h"), HasSubstr("piece_weights[] = {"));
  EXPECT_THAT(certainty_text(runs), HasSubstr("centimetres | usual | 12"));
  using session::testing::Json;
  const std::string name = "experiment-certainty.schema.json";
  Json whole = Json::parse(core::read_file(std::filesystem::path(OSTIA_SCHEMAS) / name));
  for (const char* about : {"$schema", "$id", "title"}) whole.erase(about);
  Json written = Json::parse(certainty_json(runs));
  EXPECT_TRUE(session::testing::Schema(name).is_valid(whole, written));
  written["groups"][0].erase("right");
  EXPECT_FALSE(session::testing::Schema(name).is_valid(whole, written));
}

TEST(CertaintyExperiment, TheWeightsBecomeASourceFile) {
  const std::string source = source_of({{0.5, {1.0, -2.25}}, {-1.0, {0.125}}});
  EXPECT_THAT(source, HasSubstr("piece_constant = 0.5000;"));
  EXPECT_THAT(source, HasSubstr("piece_weights[] = {1.0000, -2.2500};"));
  EXPECT_THAT(source, HasSubstr("vessel_constant = -1.0000;"));
}

TEST(CertaintyExperiment, RefusesWhatMakesNoSense) {
  CertaintyOptions options;
  options.patients = 0;
  EXPECT_THROW(judge_certainty(options), InvalidInput);
  options = {};
  options.scans = 21;
  EXPECT_THROW(judge_certainty(options), InvalidInput);
  options = {};
  options.voxel_mm = 0.1;
  EXPECT_THROW(judge_certainty(options), InvalidInput);
  EXPECT_THROW(judge_certainty_of_suite("no such suite"), InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
