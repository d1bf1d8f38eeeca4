// What a person said of a case holds for that case, and for what that person corrected in it.

#include "ostia/cohort/review.h"

#include "made_results.h"

#include "ostia/cohort/status.h"
#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::cohort {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::size_t lumen_stage = stage_of("lumen");

Review review_of_case(const MadeCohort& cohort, std::size_t scan, Verdict verdict,
                      const std::string& content) {
  return {cohort.scan(scan), verdict, "A. Reader", "2026-03-01T12:00:00Z",
          core::sha256(content).substr(0, 16)};
}

ReviewCounts counts_of(const MadeCohort& cohort) {
  return read_status(cohort.folder()).review;
}

TEST(CohortReview, TheLastOneOfACaseHolds) {
  const MadeCohort cohort("review_last", 3);
  for (std::size_t i = 0; i < 2; ++i) cohort.make_all(i, "{}");
  const TakenReviews taken =
      take_reviews(cohort.folder(), {review_of_case(cohort, 0, Verdict::again, "extract"),
                                     review_of_case(cohort, 1, Verdict::ok, "extract"),
                                     review_of_case(cohort, 0, Verdict::ok, "extract")});
  EXPECT_EQ(taken.ok, 2u);
  EXPECT_EQ(taken.again, 1u);
  EXPECT_EQ(counts_of(cohort).ok, 2u);
  EXPECT_EQ(counts_of(cohort).open, 0u);  // the third has no case
  take_reviews(cohort.folder(), {review_of_case(cohort, 1, Verdict::none, "extract")});
  EXPECT_EQ(counts_of(cohort).ok, 1u);
  EXPECT_EQ(counts_of(cohort).open, 1u);
}

TEST(CohortReview, ACaseThatWasMadeAnewIsNotReviewed) {
  const MadeCohort cohort("review_anew", 2);
  cohort.make_all(0, "{}");
  take_reviews(cohort.folder(), {review_of_case(cohort, 0, Verdict::ok, "extract")});
  cohort.make(0, reviewed_stage, "another case");
  EXPECT_EQ(counts_of(cohort).ok, 0u);
  EXPECT_EQ(counts_of(cohort).open, 1u);
  const TakenReviews taken = take_reviews(
      cohort.folder(),
      {review_of_case(cohort, 0, Verdict::ok, "extract"), review_of_case(cohort, 1, Verdict::ok, "extract")});
  EXPECT_THAT(taken.left_out, ElementsAre(cohort.scan(0), cohort.scan(1)));
  EXPECT_EQ(taken.ok, 0u);
}

TEST(CohortReview, WhatAPersonCorrectedIsTheCaseFromThenOn) {
  const MadeCohort cohort("review_corrected", 1);
  cohort.make_all(0, "{}");
  core::write_file(cohort.at(0, reviewed_stage) / "case.ostia", "corrected");
  EXPECT_EQ(read_status(cohort.folder(), {true}).stages[reviewed_stage].scans[5], 1u);  // damaged
  take_reviews(cohort.folder(), {review_of_case(cohort, 0, Verdict::ok, "extract")});
  const CohortStatus status = read_status(cohort.folder(), {true});
  EXPECT_EQ(status.stages[reviewed_stage].scans[1], 1u);
  EXPECT_EQ(status.stages[lumen_stage].scans[static_cast<std::size_t>(StageState::stale)], 1u);
  // And once more of what there is now.
  core::write_file(cohort.at(0, lumen_stage) / "lumen.vtp", "of the corrected one");
  std::filesystem::remove(cohort.at(0, lumen_stage) / "manifest.json");
  pipeline::ManifestRecord record;
  record.key = {"run", {{"input 1", core::sha256("corrected")}}, "{}"};
  pipeline::write_manifest(cohort.at(0, lumen_stage), record);
  EXPECT_EQ(read_status(cohort.folder(), {true}).stages[lumen_stage].scans[1], 1u);
}

TEST(CohortReview, OfAnotherCohortNothingIsTaken) {
  const MadeCohort cohort("review_other", 1);
  cohort.make_all(0, "{}");
  Review stranger = review_of_case(cohort, 0, Verdict::ok, "extract");
  stranger.scan = "p-00000000000000000000";
  EXPECT_THROW(take_reviews(cohort.folder(), {review_of_case(cohort, 0, Verdict::ok, "extract"), stranger}),
               InvalidInput);
  EXPECT_EQ(counts_of(cohort).ok, 0u);
}

TEST(CohortReview, AFileIsReadAsThePageExportsIt) {
  const std::vector<Review> read = parse_reviews(
      R"({"v":1,"kind":"cohort reviews","reviews":[{"scan":"p-1","verdict":"again","reader":"Zoë","time":"2026-03-01T12:00:00Z","made":"0123456789abcdef"}]})",
      "reviews.json");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].verdict, Verdict::again);
  EXPECT_EQ(read[0].reader, "Zoë");
}

TEST(CohortReview, AFileThatIsNoneIsNamedWithItsEntry) {
  const auto said = [](const std::string& text) -> std::string {
    try {
      parse_reviews(text, "reviews.json");
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const auto with = [](const std::string& verdict, const std::string& reader, const std::string& time) {
    return R"({"v":1,"kind":"cohort reviews","reviews":[{"scan":"p-1","verdict":")" + verdict +
           R"(","reader":")" + reader + R"(","time":")" + time + R"(","made":"0123456789abcdef"}]})";
  };
  EXPECT_EQ(said(with("ok", "me", "2026-03-01T12:00:00Z")), "");
  EXPECT_THAT(said("{ half"), HasSubstr("reviews.json: it holds no reviews"));
  EXPECT_THAT(said(R"({"v":2,"kind":"cohort reviews","reviews":[]})"), HasSubstr("another version"));
  EXPECT_THAT(said(with("fine", "me", "2026-03-01T12:00:00Z")), HasSubstr("review 1: its \"verdict\""));
  EXPECT_THAT(said(with("ok", "", "2026-03-01T12:00:00Z")), HasSubstr("its \"reader\""));
  EXPECT_THAT(said(with("ok", "a\\nb", "2026-03-01T12:00:00Z")), HasSubstr("its \"reader\""));
  EXPECT_THAT(said(with("ok", "me", "yesterday")), HasSubstr("its \"time\""));
}

}  // namespace
}  // namespace ostia::cohort
