// Two cohorts whose differences are known.

#include "ostia/cohort/cohort_comparison.h"

#include "made_results.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string report_of_area(double mm2, const std::string& category = "2") {
  return R"({"v":1,"kind":"case report","cad_rads":{"category":")" + category +
         R"("},"segments":[{"least_area_mm2":)" + std::to_string(mm2) + "}]}";
}

/// Scans whose imported content is told, so that two cohorts hold the same ones.
void make_scan(const MadeCohort& cohort, std::size_t scan, const std::string& source,
               const std::string& report) {
  cohort.make_all(scan, report);
  const fs::path folder = cohort.at(scan, 0);
  fs::remove(folder / "manifest.json");
  pipeline::ManifestRecord record;
  record.key = {"run", {{"input 1", core::sha256(source)}}, "{}"};
  pipeline::write_manifest(folder, record);
}

TEST(CohortComparison, TellsWhatChangedForWhom) {
  const MadeCohort before("compare_before", 4), after("compare_after", 4);
  make_scan(before, 0, "a", report_of_area(4.0));
  make_scan(before, 1, "b", report_of_area(5.0));
  make_scan(before, 2, "c", report_of_area(6.0));
  make_scan(before, 3, "of one alone", report_of_area(1.0));
  make_scan(after, 2, "a", report_of_area(4.0));  // in another order
  make_scan(after, 0, "b", report_of_area(7.0, "3"));
  make_scan(after, 1, "c", report_of_area(5.0));
  const fs::path output = after.beside("changes");
  const CohortComparison found = compare_cohorts(before.folder(), after.folder(), output);
  EXPECT_EQ(found.before, 4u);
  EXPECT_EQ(found.after, 4u);
  EXPECT_EQ(found.matched, 3u);
  EXPECT_EQ(found.changed, 2u);
  ASSERT_EQ(found.measures.size(), 4u);
  const MeasureAgreement& area = found.measures[0];
  EXPECT_EQ(area.scans, 3u);
  EXPECT_EQ(area.changed, 2u);
  // Of the differences 0, 2 and -1: mean 1/3, standard deviation sqrt(7/3).
  EXPECT_NEAR(area.bias, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(area.sd, 1.5275252316519468, 1e-12);
  EXPECT_NEAR(area.upper_limit, 1.0 / 3.0 + 1.96 * 1.5275252316519468, 1e-12);
  EXPECT_DOUBLE_EQ(area.greatest, 2.0);
  const std::string rows = core::read_file(output / "changes.csv");
  EXPECT_THAT(rows, HasSubstr(after.scan(0) + "," + before.scan(1) + ",mla_mm2,5,7,2\n"));
  EXPECT_THAT(rows, HasSubstr(after.scan(0) + "," + before.scan(1) + ",cad_rads,2,3,\n"));
  EXPECT_THAT(rows, Not(HasSubstr(after.scan(2))));
  const std::string page = core::read_file(output / "index.html");
  EXPECT_LT(page.find(after.scan(0)), page.find(after.scan(1)));  // 2 mm2 stand before 1
}

TEST(CohortComparison, WhatIsLostStandsFirst) {
  const MadeCohort before("compare_lost_before", 2), after("compare_lost_after", 2);
  make_scan(before, 0, "a", report_of_area(4.0));
  make_scan(before, 1, "b", report_of_area(5.0));
  make_scan(after, 0, "a", report_of_area(14.0));
  make_scan(after, 1, "b", report_of_area(5.0));
  fs::remove_all(after.at(1, stage_of("measures")));
  const fs::path output = after.beside("changes");
  const CohortComparison found = compare_cohorts(before.folder(), after.folder(), output);
  EXPECT_EQ(found.measures[0].lost, 1u);
  ASSERT_EQ(found.states.size(), 1u);
  EXPECT_EQ(found.states[0].stage, "measures");
  EXPECT_EQ(found.states[0].after, "waiting");
  const std::string page = core::read_file(output / "index.html");
  EXPECT_LT(page.find(after.scan(1)), page.find(after.scan(0)));
}

TEST(CohortComparison, PicturesLieBesideThePage) {
  const MadeCohort before("compare_pictures_before", 1), after("compare_pictures_after", 1);
  make_scan(before, 0, "a", report_of_area(4.0));
  make_scan(after, 0, "a", report_of_area(5.0));
  core::write_file(after.at(0, stage_of("measures")) / "report/images/tree.png", "picture");
  const fs::path output = after.beside("changes");
  compare_cohorts(before.folder(), after.folder(), output);
  EXPECT_EQ(core::read_file(output / "1-after.png"), "picture");
  EXPECT_THAT(core::read_file(output / "index.html"), Not(HasSubstr("1-before.png")));
}

TEST(CohortComparison, ContentThatSeveralScansHaveIsAmbiguousAndOneCohortIsNotTwo) {
  const MadeCohort before("compare_twice_before", 2), after("compare_twice_after", 1);
  for (std::size_t i = 0; i < 2; ++i) make_scan(before, i, "a", report_of_area(4.0));
  make_scan(after, 0, "a", report_of_area(5.0));
  const CohortComparison found = compare_cohorts(before.folder(), after.folder(), after.beside("changes"));
  EXPECT_EQ(found.ambiguous, 1u);
  EXPECT_EQ(found.matched, 0u);
  EXPECT_THROW(compare_cohorts(before.folder(), before.folder(), after.beside("itself")), InvalidInput);
}

}  // namespace
}  // namespace ostia::cohort
