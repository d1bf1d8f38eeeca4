// Medina's classes in the report of a case.

#include "report_cases.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::session {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double joint_mm = 20.0, main_mm = 2.0, side_mm = 1.2;  // of a YTree

double narrowed(double s, double centre) {
  const double x = std::abs(s - centre) / 2.5;
  return x < 1.0 ? 1.0 - 0.65 * 0.5 * (1.0 + std::cos(M_PI * x)) : 1.0;
}

/// LAD along z, an LCX at 45 degrees; both narrowed by 65 % at the bifurcation, or neither.
lumen::LumenModel left_tree(bool diseased) {
  lumen::testing::YTree y;
  y.side_name = "LCX";
  const double proximal = joint_mm - 3.0, side = joint_mm + main_mm * std::numbers::sqrt2 + 2.5;
  return lumen::model_of_walls(
      y.tree(), {[=](double s, double) { return main_mm * (diseased ? narrowed(s, proximal) : 1.0); },
                 [=](double s, double) { return side_mm * (diseased ? narrowed(s, side) : 1.0); }});
}

TEST(CaseReportBifurcations, ALesionOfTheLeftMainAndOfTheCircumflexsOstiumIsOneZeroOne) {
  const CaseReport report = testing::checked_report(left_tree(true));
  ASSERT_EQ(report.bifurcations.size(), 1U);
  EXPECT_EQ(analysis::to_string(report.bifurcations[0].medina), "1,0,1");
  EXPECT_EQ(report.bifurcations[0].main_name, "LAD");
  EXPECT_EQ(report.bifurcations[0].side_name, "LCX");
  ASSERT_EQ(report.stenoses.size(), 2U);  // each at its own vessel
  EXPECT_EQ(report.stenoses[0].vessel_name, "LAD");
  EXPECT_EQ(report.stenoses[0].main_vessel, "LM");
  EXPECT_EQ(report.stenoses[1].vessel_name, "LCX");
  for (const ReportStenosis& one : report.stenoses) {
    EXPECT_EQ(one.medina, "1,0,1");
    EXPECT_EQ(one.bifurcation, "LAD/LCX");
  }
  EXPECT_NEAR(report.stenoses[1].stenosis.reference_diameter_mm, 2.0 * side_mm, 0.15);
  const std::string text = report_json(report, {});
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["bifurcations"][0]["medina"], "1,0,1");
  EXPECT_EQ(json["stenoses"][1]["medina"], "1,0,1");
  EXPECT_THAT(report_html(report, {}), HasSubstr("Bifurcation lesions"));
}

TEST(CaseReportBifurcations, AHealthyOneIsInTheTableForScriptsAlone) {
  const CaseReport report = testing::checked_report(left_tree(false));
  ASSERT_EQ(report.bifurcations.size(), 1U);
  EXPECT_EQ(analysis::to_string(report.bifurcations[0].medina), "0,0,0");
  EXPECT_TRUE(report.stenoses.empty());
  EXPECT_THAT(report_html(report, {}), Not(HasSubstr("Bifurcation lesions")));
  ReportOptions thin;
  thin.medina.least_side_mm = 3.0;
  EXPECT_TRUE(testing::checked_report(left_tree(false), nullptr, thin).bifurcations.empty());
  thin.medina.region_mm = 99.0;
  EXPECT_THROW(testing::checked_report(left_tree(false), nullptr, thin), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
