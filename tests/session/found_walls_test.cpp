// Walls that table and display want to know are looked for once.

#include "ostia/session/found_walls.h"

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/session/lesion_board.h"
#include "ostia/session/outer_wall_board.h"

#include <gtest/gtest.h>

#include <future>

namespace ostia::session {
namespace {

using namespace testing;

struct FoundWallsTest : ::testing::Test {
  std::shared_ptr<const lumen::LumenModel> model =
      std::make_shared<const lumen::LumenModel>(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.9));
  std::shared_ptr<const imaging::ImageVolume> image =
      std::make_shared<const imaging::ImageVolume>(walled_image(1.5, 2.6, 60.0));
  FoundWalls found;

  WallsWanted wanted() const {
    WallsWanted out{model, {}, image, model->tree.vessels.front().id};
    out.walls[out.vessel] = solved_surfaces(*model)(out.vessel);
    return out;
  }
};

TEST_F(FoundWallsTest, AreThoseOfVesselWallsAndLookedForOnce) {
  const WallsWanted one = wanted();
  const auto first = found.of(one), again = found.of(one);
  ASSERT_TRUE(first);
  EXPECT_EQ(first, again);
  EXPECT_EQ(found.searches(), 1);
  const auto alone = vessel_walls(*model, solved_surfaces(*model), one.vessel, *image);
  ASSERT_TRUE(alone);
  EXPECT_EQ(first->outer.surface.radius_mm, alone->outer.surface.radius_mm);
  EXPECT_TRUE(first->maps.empty());
}

TEST_F(FoundWallsTest, WhoAsksBesideTheFirstWaitsForIt) {
  const WallsWanted one = wanted();
  std::vector<std::future<std::shared_ptr<const VesselWalls>>> asking;
  for (int i = 0; i < 4; ++i) asking.push_back(std::async(std::launch::async, [&] { return found.of(one); }));
  std::vector<std::shared_ptr<const VesselWalls>> told;
  for (auto& ask : asking) told.push_back(ask.get());
  for (const auto& walls : told) EXPECT_EQ(walls, told.front());
  EXPECT_EQ(found.searches(), 1);
}

TEST_F(FoundWallsTest, WhereTheFirstGivesUpTheNextOneLooks) {
  const WallsWanted one = wanted();
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(found.of(one, cancelled), Cancelled);
  EXPECT_TRUE(found.of(one));
  EXPECT_EQ(found.searches(), 2);
}

TEST_F(FoundWallsTest, OfAnotherModelOrImageTheyAreOthersAndNeitherIsKeptAlive) {
  const std::weak_ptr<const lumen::LumenModel> first_model = model;
  const std::weak_ptr<const imaging::ImageVolume> first_image = image;
  const auto narrow = found.of(wanted());
  model = std::make_shared<const lumen::LumenModel>(narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5));
  EXPECT_TRUE(first_model.expired());
  const auto wide = found.of(wanted());
  ASSERT_TRUE(narrow && wide);
  EXPECT_NE(narrow->lumen.radius_mm, wide->lumen.radius_mm);
  imaging::ImageVolume moved = *image;
  moved.geometry.origin.z() = 60.0;
  image = std::make_shared<const imaging::ImageVolume>(std::move(moved));
  EXPECT_TRUE(first_image.expired());
  EXPECT_FALSE(found.of(wanted())) << "the vessel is not in it";
  EXPECT_EQ(found.searches(), 3);
}

TEST_F(FoundWallsTest, TableAndDisplayShareThem) {
  TempFolder folder;
  Workbench bench;
  EvaluabilityBoard evaluability(bench);
  OuterWallBoard display(bench);
  LesionBoard table(bench, evaluability, display.found());
  const ImageReference reference{std::string(64, 'a'), "case-aaaa"};
  bench.set_session(Session(CaseFile::create(folder / "a.ostia", *model, reference)));
  bench.set_image({image, reference});
  bench.vessel.set(bench.model()->tree.vessels.front().id);
  const auto of_table = table.work();
  const auto of_display = display.work();
  ASSERT_TRUE(of_table && of_display);
  const auto plaque = of_table->found();
  const auto walls = of_display->found();
  ASSERT_TRUE(plaque && walls);
  EXPECT_EQ(display.found()->searches(), 1);
  OuterWallsOptions with_maps;
  with_maps.maps = true;
  const auto alone = vessel_walls(*of_display->model, solved_surfaces(*of_display->model), of_display->vessel,
                                  *image, with_maps);
  ASSERT_TRUE(alone);
  ASSERT_EQ(walls->maps.size(), alone->maps.size());
  ASSERT_FALSE(walls->maps.empty());
  for (std::size_t i = 0; i < walls->maps.size(); ++i)
    EXPECT_EQ(walls->maps[i].pieces, alone->maps[i].pieces);
  EXPECT_EQ(plaque->slabs.size(), walls->plaque.slabs.size());
  EXPECT_TRUE(table.take(*of_table, plaque));
  EXPECT_TRUE(display.take(*of_display, walls));
  bench.edit(ring(20.0, 1.2));
  const auto after = table.work();
  ASSERT_TRUE(after);
  after->found();
  EXPECT_EQ(display.found()->searches(), 2) << "the wall moved";
}

}  // namespace
}  // namespace ostia::session
