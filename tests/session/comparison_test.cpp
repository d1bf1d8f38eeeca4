// Two cases with known narrowings, compared: files, verdicts, cohorts.

#include "ostia/session/comparison.h"

#include "report_cases.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace ostia::session {
namespace {

using analysis::ChangeMeasure;
using analysis::ChangeScope;
using analysis::ChangeVerdict;
using ::testing::HasSubstr;
using testing::narrowed_y;
using testing::report_of;
using Json = nlohmann::json;
namespace fs = std::filesystem;

ComparedCase case_of(const lumen::LumenModel& model) {
  return compared_case(model, report_of(model));
}

ComparisonOptions told_from(double mm2) {
  ComparisonOptions options;
  for (auto& scope : options.change.repeatability.spreads)
    for (analysis::DifferenceSpread& one : scope) one.sd = mm2 / 1.96;
  options.change.repeatability.from = "a test";
  return options;
}

/// LAD narrowed at 10 mm behind the fork by 30 % before and 60 % now.
const Comparison& grown() {
  static const Comparison made =
      compare_cases(case_of(narrowed_y(1, 12.0, 0.3)), case_of(narrowed_y(1, 12.0, 0.6)), told_from(0.5));
  return made;
}

TEST(Comparison, ALesionThatGrewIsTold) {
  const Comparison& made = grown();
  EXPECT_TRUE(made.another_patient.empty());
  EXPECT_LT(made.fit.axes_mm, 1e-3);
  ASSERT_EQ(made.change.lesions.size(), 1u);
  const analysis::LesionChange& lesion = made.change.lesions[0];
  EXPECT_EQ(lesion.fate, analysis::LesionFate::both);
  EXPECT_EQ(lesion.vessel_name, "LAD");
  const auto& area = analysis::of(lesion.change, ChangeMeasure::least_area);
  EXPECT_EQ(area.verdict(), ChangeVerdict::less);
  const auto square = [](double x) { return x * x; };
  EXPECT_NEAR(*area.after / *area.before, square(0.4 / 0.7), 0.06);
  EXPECT_THAT(made.warnings, ::testing::Contains(HasSubstr("plaque is not compared")));
}

TEST(Comparison, ItsFilesSayTheSame) {
  const Json json = Json::parse(comparison_json(grown()));
  EXPECT_EQ(testing::names_in(testing::Schema("comparison.schema.json")["properties"]),
            testing::names_in(json));
  EXPECT_EQ(json["lesions"][0]["fate"], "both");
  EXPECT_EQ(json["lesions"][0]["measures"]["mla_mm2"]["verdict"], "less");
  EXPECT_EQ(json["repeatability"]["from"], "a test");
  const std::string csv = comparison_csv(grown());
  EXPECT_THAT(csv, HasSubstr("both,mla_mm2,"));
  const auto images = comparison_images(grown());
  EXPECT_EQ(images.size(), 2u);
  const std::string page = comparison_html(grown(), images);
  EXPECT_THAT(page, HasSubstr("not a medical device"));
  EXPECT_THAT(page, HasSubstr("S1 \u2192 S1"));
  EXPECT_EQ(comparison_pdf(grown(), images).substr(0, 5), "%PDF-");
}

TEST(Comparison, AnotherPatientIsRefusedUnlessAsked) {
  lumen::LumenModel other = narrowed_y(1, 12.0, 0.3);
  ComparisonOptions options = told_from(0.5);
  options.bounds.shared_share = 1.5;  // stands for trees that lie otherwise: no tree shares that
  try {
    compare_cases(case_of(narrowed_y(2, 12.0, 0.3)), case_of(other), options);
    FAIL() << "compared";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("--anyway"));
  }
  options.anyway = true;
  const Comparison made = compare_cases(case_of(narrowed_y(2, 12.0, 0.3)), case_of(other), options);
  EXPECT_FALSE(made.another_patient.empty());
  EXPECT_EQ(Json::parse(comparison_json(made))["one_patient"], false);
}

TEST(Comparison, AMapTakesThePlaceOfTheTrees) {
  const ScanMap shifted{[](const geometry::Vec3& p) -> geometry::Vec3 { return p; },
                        "deformable, by the images"};
  const Comparison made = compare_cases(case_of(narrowed_y(1, 12.0, 0.3)), case_of(narrowed_y(1, 12.0, 0.3)),
                                        told_from(0.5), shifted);
  EXPECT_EQ(made.map_words, "deformable, by the images");
  for (const ChangeMeasure measure : {ChangeMeasure::least_area, ChangeMeasure::length})
    EXPECT_EQ(analysis::of(made.change.lesions.at(0).change, measure).verdict(), ChangeVerdict::unchanged);
}

TEST(Comparison, AFolderIsMadeWhole) {
  const fs::path folder = fs::path(::testing::TempDir()) / "ostia-comparison";
  fs::remove_all(folder);
  write_comparison(folder, grown(), {"compare", {}, "{}"}, ExitCode::ok);
  for (const char* name :
       {"comparison.json", "comparison.csv", "comparison.html", "comparison.pdf", "manifest.json"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(core::read_file(folder / "comparison.json"), comparison_json(grown()));
  fs::remove_all(folder);
}

/// Differences of +-sd about values that grow with `share`.
std::vector<CohortRow> made_rows(double sd, double share) {
  std::vector<CohortRow> rows;
  for (int i = 0; i < 40; ++i) {
    const double mean = 10.0 + 5.0 * (i / 2), by = (i % 2 == 0 ? 1.0 : -1.0) * std::hypot(sd, share * mean);
    rows.push_back({"p" + std::to_string(i),
                    ChangeScope::lesion,
                    "S1",
                    ChangeMeasure::plaque,
                    {mean - 0.5 * by, mean + 0.5 * by, {}}});
  }
  return rows;
}

TEST(Comparison, ACohortSaysWhatTwoScansDifferBy) {
  const auto flat = cohort_repeatability(made_rows(3.0, 0.0), "test");
  EXPECT_NEAR(flat.of(ChangeScope::lesion, ChangeMeasure::plaque).at(50.0), 3.0, 1e-9);
  const auto grows =
      cohort_repeatability(made_rows(2.0, 0.05), "test").of(ChangeScope::lesion, ChangeMeasure::plaque);
  EXPECT_NEAR(grows.sd, 2.0, 1e-6);
  EXPECT_NEAR(grows.share, 0.05, 1e-8);
  const std::string text = cohort_json(made_rows(2.0, 0.05), {});
  const Json json = Json::parse(text);
  EXPECT_EQ(testing::names_in(testing::Schema("cohort.schema.json")["properties"]), testing::names_in(json));
  EXPECT_EQ(json["pairs"], 40);
  EXPECT_NEAR(json["agreement"][0]["bias"].get<double>(), 0.0, 1e-9);
  const auto back = repeatability_of_json(text, "cohort.json");
  EXPECT_NEAR(back.of(ChangeScope::lesion, ChangeMeasure::plaque).share, 0.05, 1e-8);
  EXPECT_THAT(cohort_html(made_rows(2.0, 0.05), {"p7: a word"}), HasSubstr("p7: a word"));
  EXPECT_THAT(cohort_csv(made_rows(2.0, 0.0)), HasSubstr("p0,lesion,S1,plaque_mm3,"));
}

TEST(Comparison, ATableThatIsNoneIsRefused) {
  for (const char* text : {"", "[]", "{\"repeatability\": 3}", "{\"repeatability\": {\"lesion\": 1}}",
                           "{\"repeatability\": {\"lesion\": {\"mla_mm2\": {\"sd\": -1, \"share\": 0}}}}",
                           "{\"repeatability\": {\"lesion\": {\"mla_mm2\": {\"sd\": \"x\"}}}}"})
    try {
      repeatability_of_json(text, "table.json");
      ADD_FAILURE() << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("table.json: "));
    }
}

}  // namespace
}  // namespace ostia::session
