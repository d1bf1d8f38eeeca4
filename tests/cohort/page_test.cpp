// What stands in the data of a cohort's page. That a browser shows it is page_browser_test.py's.

#include "ostia/cohort/page.h"

#include "made_results.h"

#include "ostia/cohort/review.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* measured = R"json({"v":1,"kind":"case report","cad_rads":{"category":"4A"},
 "vessels":[{"plaque":{"plaque_mm3":30.0}},{"plaque":null},{"plaque":{"plaque_mm3":12.5}}],
 "segments":[{"least_area_mm2":4.5},{"least_area_mm2":2.25},{"least_area_mm2":null}],
 "stenoses":[{"diameter_percent":30.0},{"diameter_percent":71.0}]})json";
constexpr const char* pressures = R"({"v":1,"kind":"ffr","outlets":[{"ffr":0.9},{"ffr":0.76},{"ffr":null}]})";

/// What a file of the page's data hands to the page, as an array of arguments.
json data_of(const MadeCohort& cohort, const std::string& name) {
  const std::string text = core::read_file(cohort.folder() / "page/data" / (name + ".js"));
  const std::size_t from = text.find('(') + 1;
  return json::parse("[" + text.substr(from, text.rfind(')') - from) + "]");
}

TEST(CohortPage, HoldsAScanInItsPlaceWithTheWorstOfItsResults) {
  const MadeCohort cohort("page_rows", 3);
  cohort.make_all(1, measured, pressures);
  cohort.record(2, 0, "3", "null", "no slices in 7 files");
  const PageResult made = write_page(cohort.folder());
  EXPECT_EQ(made.scans, 3u);
  const json rows = data_of(cohort, "rows-0")[1];
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1][0], cohort.scan(1));
  EXPECT_EQ(rows[1][2], "mask");
  EXPECT_EQ(rows[1][3], core::sha256("extract").substr(0, 16));
  EXPECT_EQ(json(rows[1].begin() + 4, rows[1].end()), json({"4A", 2.25, 71.0, 42.5, 0.76}));
  EXPECT_EQ(rows[0][3], "");
  EXPECT_TRUE(rows[0][5].is_null());
}

TEST(CohortPage, TheIndexHasStatesFailuresAndBins) {
  const MadeCohort cohort("page_index", 3);
  cohort.make_all(1, measured, pressures);
  cohort.record(2, 0, "3", "null", "no slices in 7 files");
  write_page(cohort.folder());
  const std::string index = data_of(cohort, "index-0")[1];
  const auto hex = [&](std::size_t scan) { return cohort.scan(scan).substr(2, 4); };
  // Areas in bins of 0.5 from 0: 2.25 is in the fifth. 71 % in steps of 5: the 15th, E. 42.5 in 25: the
  // second. 0.76 in 0.025: the 31st, V.
  EXPECT_EQ(index,
            "000000"
            "00"
            "0000" +
                hex(0) +
                "111111"
                "00"
                "5F2V" +
                hex(1) +
                "300000"
                "01"
                "0000" +
                hex(2));
  const json summary = data_of(cohort, "summary")[0];
  EXPECT_EQ(summary["whole"], 1);
  EXPECT_EQ(summary["reasons"][0]["reason"], "no slices in # files");
  EXPECT_EQ(summary["reasons"][0]["row"], 2);
  EXPECT_EQ(summary["sets"], json::parse("[[0,[]],[1,[0]]]"));
  EXPECT_EQ(summary["measures"][0]["bins"][4], 1);
  EXPECT_EQ(summary["stages"][0]["counts"], json({1, 1, 0, 1, 0, 0}));
}

TEST(CohortPage, IsTheSameBitsAgainAndReadsNoResultTwice) {
  const MadeCohort cohort("page_again", 2);
  cohort.make_all(0, measured, pressures);
  write_page(cohort.folder());
  const std::string rows = data_of(cohort, "rows-0").dump();
  // Of the same size and, as the system has it, never written: what is shown is what was read before.
  const fs::path report = cohort.at(0, stage_of("measures")) / "report/report.json";
  std::string other = core::read_file(report);
  other.replace(other.find("71.0"), 4, "11.0");
  const auto when = fs::last_write_time(report);
  core::write_file(report, other);
  fs::last_write_time(report, when);
  write_page(cohort.folder());
  EXPECT_EQ(data_of(cohort, "rows-0").dump(), rows);
}

TEST(CohortPage, ShowsReviewsAndThoseThatAreTakenInLater) {
  const MadeCohort cohort("page_reviews", 2);
  for (std::size_t i = 0; i < 2; ++i) cohort.make_all(i, "{}");
  write_page(cohort.folder());
  EXPECT_TRUE(data_of(cohort, "reviews")[0]["rows"].empty());
  take_reviews(cohort.folder(), {{cohort.scan(1), Verdict::ok, "A. \"Reader\" <b>", "2026-03-01T12:00:00Z",
                                  core::sha256("extract").substr(0, 16)}});
  const json reviews = data_of(cohort, "reviews")[0];
  EXPECT_EQ(reviews["rows"], json::parse(R"([[1,"ok",0,"2026-03-01T12:00:00Z"]])"));
  EXPECT_EQ(reviews["readers"][0], "A. \"Reader\" <b>");
  cohort.make(1, reviewed_stage, "another case");
  write_page(cohort.folder());
  EXPECT_TRUE(data_of(cohort, "reviews")[0]["rows"].empty());
}

TEST(CohortPage, NamesNobodyAndReachesNowhere) {
  const MadeCohort cohort("page_private", 2);
  cohort.make_all(0, measured, pressures);
  write_page(cohort.folder());
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(cohort.folder() / "page"))
    if (entry.is_regular_file()) all += core::read_file(entry.path());
  EXPECT_THAT(all, Not(HasSubstr("scan0.nrrd")));
  EXPECT_THAT(all, Not(HasSubstr(cohort.folder().parent_path().string())));
  EXPECT_THAT(all, Not(HasSubstr("://")));
}

TEST(CohortPage, AResultThatCannotBeReadIsNotKnown) {
  const MadeCohort cohort("page_odd", 1);
  cohort.make_all(0, "no report", R"({"outlets":"none"})");
  write_page(cohort.folder());
  EXPECT_TRUE(data_of(cohort, "rows-0")[1][0][5].is_null());
}

}  // namespace
}  // namespace ostia::cohort
