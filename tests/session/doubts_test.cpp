#include "ostia/session/doubts.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using coronary::VesselCertainty;
using testing::TempFolder;
using testing::tube_vessel;

/// Of the tube along z, 30 mm long, three pieces.
std::vector<VesselCertainty> certainty_of_tube(const std::vector<double>& probabilities,
                                               double of_vessel = 0.95) {
  VesselCertainty one;
  one.vessel = tube_vessel;
  one.probability = of_vessel;
  for (std::size_t k = 0; k < probabilities.size(); ++k) {
    coronary::VesselPiece piece;
    piece.from_mm = 10.0 * static_cast<double>(k), piece.to_mm = piece.from_mm + 10.0;
    piece.place = {0.0, 0.0, piece.from_mm + 5.0};
    piece.probability = probabilities[k];
    one.pieces.push_back(piece);
  }
  return {one};
}

TEST(Doubts, AreKeptWithTheCase) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "case.ostia", testing::tube_model());
  EXPECT_TRUE(kept_certainty(file).empty());
  keep_certainty(file, certainty_of_tube({0.99, 0.5, 0.75}, 0.625));
  const std::vector<VesselCertainty> kept = kept_certainty(file);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].vessel, tube_vessel);
  EXPECT_EQ(kept[0].probability, 0.625);
  ASSERT_EQ(kept[0].pieces.size(), 3U);
  EXPECT_EQ(kept[0].pieces[1].probability, 0.5);
  EXPECT_EQ(kept[0].pieces[1].from_mm, 10.0);
  EXPECT_LT((kept[0].pieces[2].place - geometry::Vec3(0.0, 0.0, 25.0)).norm(), 1e-3);
  for (const char* unread : {"no JSON", R"({"v":2,"vessels":[]})", R"({"v":1,"vessels":[{"id":4}]})"}) {
    file.set_setting("certainty", unread);
    EXPECT_TRUE(kept_certainty(file).empty()) << unread;
  }
}

TEST(Doubts, TheLeastSureIsFirstAndNeighboursAreOnePlace) {
  const lumen::LumenModel model = testing::tube_model();
  const auto apart = doubtful_places(certainty_of_tube({0.8, 0.99, 0.3}), model, {});
  ASSERT_EQ(apart.size(), 2U);
  EXPECT_EQ(apart[0].probability, 0.3);
  EXPECT_NEAR(apart[0].s_mm, 25.0, 1e-3);
  EXPECT_NEAR(apart[0].from_mm, 20.0, 1e-3);
  EXPECT_EQ(apart[1].probability, 0.8);
  const auto together = doubtful_places(certainty_of_tube({0.95, 0.7, 0.4}), model, {});
  ASSERT_EQ(together.size(), 1U);
  EXPECT_EQ(together[0].probability, 0.4);
  EXPECT_NEAR(together[0].from_mm, 10.0, 1e-3);
  EXPECT_NEAR(together[0].to_mm, 30.0, 1e-3);
  EXPECT_NEAR(together[0].s_mm, 25.0, 1e-3);
  EXPECT_TRUE(doubtful_places(certainty_of_tube({0.95, 0.9, 0.99}), model, {}).empty());
}

TEST(Doubts, AVesselThatIsDoubtfulAsAWholeHasAPlace) {
  const auto places = doubtful_places(certainty_of_tube({0.97, 0.92, 0.98}, 0.6), testing::tube_model(), {});
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].probability, 0.6);
  EXPECT_NEAR(places[0].s_mm, 15.0, 1e-3);
}

TEST(Doubts, WhatAPersonHasCheckedOrChangedIsNoDoubtAnyMore) {
  const auto certainty = certainty_of_tube({0.8, 0.99, 0.3});
  const lumen::LumenModel model = testing::tube_model();
  Annotations checked;
  checked.marks = {{tube_vessel, true, true, std::nullopt, ""}};
  EXPECT_TRUE(doubtful_places(certainty, model, checked).empty());
  checked.marks[0].checked = false;
  EXPECT_EQ(doubtful_places(certainty, model, checked).size(), 2U);
  const lumen::LumenModel cut = lumen::apply(model, lumen::AxisTrim{tube_vessel, 18.0}).model;
  const auto left = doubtful_places(certainty, cut, {});
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].probability, 0.8);
}

TEST(Doubts, APlaceGoesWithTheVesselThatItLiesOnAfterASplit) {
  const auto certainty = certainty_of_tube({0.8, 0.99, 0.3});
  const lumen::LumenModel split =
      lumen::apply(testing::tube_model(), lumen::BranchSplit{tube_vessel, 15.0, {}}).model;
  ASSERT_EQ(split.vessels.size(), 2U);
  const auto places = doubtful_places(certainty, split, {});
  ASSERT_EQ(places.size(), 2U);
  EXPECT_NE(places[0].vessel, places[1].vessel);
  EXPECT_EQ(places[1].vessel, tube_vessel);
}

TEST(Doubts, AVesselIsHardlyAnArteryUntilAPersonHasSeenToIt) {
  const lumen::LumenModel model = testing::tube_model();
  const auto certainty = certainty_of_tube({0.02, 0.01, 0.05}, 0.01);
  const std::map<std::int32_t, double> unlikely = unlikely_vessels(certainty, model, {});
  ASSERT_EQ(unlikely.size(), 1U);
  EXPECT_EQ(unlikely.at(tube_vessel), 0.01);
  EXPECT_TRUE(unlikely_vessels(certainty_of_tube({0.02, 0.9, 0.9}, 0.4), model, {}).empty());
  Annotations checked;
  checked.marks = {{tube_vessel, true, true, std::nullopt, ""}};
  EXPECT_TRUE(unlikely_vessels(certainty, model, checked).empty());
  auto elsewhere = certainty;  // the axis was drawn anew since
  for (coronary::VesselPiece& piece : elsewhere[0].pieces) piece.place.x() += 8.0;
  EXPECT_TRUE(unlikely_vessels(elsewhere, model, {}).empty());
}

TEST(Doubts, AreToldInWords) {
  EXPECT_EQ(doubt_text(certainty_of_tube({0.99, 0.95, 0.97})[0]), "");
  EXPECT_EQ(doubt_text(certainty_of_tube({0.99, 0.31, 0.97}, 0.62)[0]),
            "probability 0.62, 0.31 from 10.0 to 20.0 mm");
  EXPECT_EQ(doubt_text(certainty_of_tube({0.9, 0.95, 0.97}, 0.62)[0]), "probability 0.62");
  EXPECT_EQ(doubt_text(certainty_of_tube({0.31}, 0.62)[0]), "probability 0.62");
  EXPECT_EQ(doubt_text({}), "");
}

}  // namespace
}  // namespace ostia::session
