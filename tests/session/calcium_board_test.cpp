// A person's words on the lesions of a calcium score: counted, kept in a case without vessels, taken back.

#include "ostia/session/calcium_board.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using analysis::CalciumPlace;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two lesions on a grid of 1 x 1 x 3 mm: number 1 of 30 at (10, 10, 6), a row of three voxels; number 2 of
/// 12 at (20, 12, 9).
CalciumReading two_lesions() {
  auto scored = std::make_shared<analysis::ScoredCalcium>();
  scored->lesion_numbers.geometry.size = {32, 32, 6};
  scored->lesion_numbers.geometry.spacing = {1.0, 1.0, 3.0};
  scored->lesion_numbers.voxels.assign(32 * 32 * 6, 0);
  for (int i = 9; i <= 11; ++i)
    scored->lesion_numbers.voxels[static_cast<std::size_t>(i + 32 * (10 + 32 * 2))] = 1;
  scored->lesion_numbers.voxels[20 + 32 * (12 + 32 * 3)] = 2;
  analysis::CalciumLesion one, two;
  one.number = 1, one.place = one.proposed = CalciumPlace::lad, one.centre = {10.0, 10.0, 6.0};
  one.amount = {30.0, 9.0, 9.0, 0.0};
  two.number = 2, two.place = two.proposed = CalciumPlace::other, two.centre = {20.0, 12.0, 9.0};
  two.amount = {12.0, 3.0, 3.0, 0.0};
  scored->score.lesions = {one, two};
  scored->score = analysis::with_places(scored->score, {});
  auto scan = std::make_shared<imaging::ImageVolume>();
  return {scan, {std::string(64, 'a'), "image-aaaaaaaa"}, {}, scored};
}

struct CalciumBoardTest : ::testing::Test {
  TempFolder folder;
  fs::path path = folder / "image-aaaaaaaa-calcium.ostia";
  CalciumBoard board;
};

TEST_F(CalciumBoardTest, WordsAreCountedKeptAndTakenBack) {
  board.take(two_lesions(), path);
  EXPECT_DOUBLE_EQ(board.score().total.agatston, 30.0);
  EXPECT_FALSE(fs::exists(path)) << "who only looks leaves nothing";
  board.set_author("Dr. A");
  board.say(2, CalciumPlace::rca);
  EXPECT_DOUBLE_EQ(board.score().total.agatston, 42.0);
  board.say(1, CalciumPlace::other);
  EXPECT_DOUBLE_EQ(board.score().total.agatston, 12.0);
  EXPECT_TRUE(board.lesion(1)->assigned);
  EXPECT_TRUE(board.undo());
  EXPECT_DOUBLE_EQ(board.score().total.agatston, 42.0);
  EXPECT_FALSE(board.lesion(1)->assigned);
  EXPECT_TRUE(board.redo());
  board.say(1, CalciumPlace::other);  // said already: no step
  board.close();
  const CaseFile file = CaseFile::open(path);
  EXPECT_THAT(file.model()->vessels, IsEmpty());
  ASSERT_EQ(file.journal().size(), 5U);  // start, two words, back, again
  EXPECT_EQ(file.journal()[1].op, "calcium.places");
  EXPECT_EQ(file.journal()[1].author, "Dr. A");
  EXPECT_THAT(file.annotations()->report.calcium,
              ElementsAre(CalciumWord{{20.0, 12.0, 9.0}, CalciumPlace::rca},
                          CalciumWord{{10.0, 10.0, 6.0}, CalciumPlace::other}));
}

TEST_F(CalciumBoardTest, WhatWasSaidCountsWhenTheScanIsScoredAgain) {
  board.take(two_lesions(), path);
  board.say(2, CalciumPlace::lcx);
  board.close();
  EXPECT_EQ(board.reading(), nullptr);
  board.take(two_lesions(), path);
  EXPECT_DOUBLE_EQ(board.score().of(CalciumPlace::lcx).agatston, 12.0);
  EXPECT_TRUE(board.can_undo());
  board.take(two_lesions(), path);  // with the case open already
  EXPECT_DOUBLE_EQ(board.score().total.agatston, 42.0);
}

TEST_F(CalciumBoardTest, ACaseOfAnotherScanIsRefusedAndTheReadingStays) {
  CalciumReading other = two_lesions();
  other.reference.sha256 = std::string(64, 'b');
  board.take(two_lesions(), path);
  board.say(2, CalciumPlace::lcx);
  CalciumBoard second;
  second.take(two_lesions(), folder / "none.ostia");
  board.close();
  EXPECT_THROW(second.take(other, path), InvalidInput);
  EXPECT_DOUBLE_EQ(second.score().total.agatston, 30.0);
  EXPECT_THROW(second.say(3, CalciumPlace::lad), InvalidInput);
}

TEST_F(CalciumBoardTest, APlaceIsInALesionOrBesideIt) {
  board.take(two_lesions(), path);
  EXPECT_EQ(board.lesion_at({11.3, 10.2, 7.0}), 1);
  EXPECT_EQ(board.lesion_at({20.0, 13.5, 9.0}), 2);
  EXPECT_EQ(board.lesion_at({20.0, 15.0, 9.0}), 0);
  EXPECT_EQ(board.lesion_at({500.0, 0.0, -500.0}), 0);
}

TEST(CalciumWords, AreOfTheNearestLesionAndComeBackFromJson) {
  const std::vector<CalciumWord> words{{{10.5, 10.0, 6.0}, CalciumPlace::rca},
                                       {{40.0, 10.0, 6.0}, CalciumPlace::lad}};
  EXPECT_THAT(places_said(words, two_lesions().scored->score.lesions),
              ElementsAre(std::pair(1, CalciumPlace::rca)));
  const auto back = annotation_of_json(to_json(AnnotationCommand(SetCalciumPlaces{words})));
  EXPECT_EQ(std::get<SetCalciumPlaces>(back).words, words);
  EXPECT_THROW(validate({{{1e9, 0.0, 0.0}, CalciumPlace::lad}}), InvalidInput);
  EXPECT_THROW(annotation_of_json(
                   R"({"v": 1, "op": "calcium.places", "words": [{"centre": [0, 0, 0], "place": "leg"}]})"),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::session
