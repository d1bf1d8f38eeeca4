// The tree that is found upon opening an image, and that it stays out of a person's way.

#include "kept_scan.h"
#include "tube_case.h"
#include "vessels/finder.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QStatusBar>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::TestWindow;
using testing::wait_until;

/// A computed patient, coarse.
const phantom::Scan& patient() {
  static const phantom::Scan scan = [] {
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    return ostia::testing::kept_scan(phantom::plan_case(options));
  }();
  return scan;
}

struct VesselFinderTest : ::testing::Test {
  testing::Folder folder;
  TestWindow test{folder / "state"};
  bool idle() {
    return wait_until([&] { return !test.window().jobs().any(); }, 120000);
  }
};

TEST_F(VesselFinderTest, AnOpenedAngiogramGetsItsLabelledTreeWithoutAClick) {
  imaging::write_image(folder / "heart.nrrd", patient().image);
  test.window().open(folder / "heart.nrrd");
  ASSERT_TRUE(idle());
  ASSERT_TRUE(test.bench().has_case()) << test.window().statusBar()->currentMessage().toStdString();
  std::vector<std::string> names;
  for (const geometry::Vessel& vessel : test.bench().model()->tree.vessels) names.push_back(vessel.name);
  for (const char* wanted : {"LAD", "LCX", "RCA"})
    EXPECT_EQ(std::count(names.begin(), names.end(), wanted), 1) << wanted;
  EXPECT_FALSE(test.window().findChild<QAction*>("vessel.find")->isEnabled());
  // Doubt is shown until a person has ticked the vessel.
  auto* list = test.window().findChild<VesselList*>("vessels");
  const auto annotations = test.bench().session().file().annotations();
  int doubtful = 0, shown = 0;
  for (const session::VesselMark& mark : annotations->marks) doubtful += mark.note.empty() ? 0 : 1;
  for (int i = 0; i < list->topLevelItemCount(); ++i) shown += list->topLevelItem(i)->text(5) == "?" ? 1 : 0;
  EXPECT_EQ(shown, doubtful);
  // The wall can be edited like any other.
  const std::int32_t vessel = test.bench().vessel.get();
  EXPECT_NO_THROW(test.bench().edit(lumen::VesselRename{vessel, "mine"}));
}

TEST_F(VesselFinderTest, WhatIsNoHeartIsSaidInALineAndTheGuidedWayIsOpen) {
  imaging::write_image(folder / "tube.nrrd", testing::tube_image());
  test.window().open(folder / "tube.nrrd");
  ASSERT_TRUE(idle());
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_TRUE(test.window().statusBar()->currentMessage().contains("not found by themselves"))
      << test.window().statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(test.window().findChild<QAction*>("vessel.find")->isEnabled());
}

TEST_F(VesselFinderTest, APersonsFirstClickStopsTheSearchAndAnotherImageToo) {
  imaging::write_image(folder / "heart.nrrd", patient().image);
  imaging::write_image(folder / "tube.nrrd", testing::tube_image());
  test.window().open(folder / "heart.nrrd");
  ASSERT_TRUE(wait_until([&] { return test.window().jobs().running("tree"); }));
  test.window().finder().find_vessel(test.bench().place.get());
  ASSERT_TRUE(idle());
  EXPECT_FALSE(test.bench().has_case());
  test.window().finder().find_tree();
  ASSERT_TRUE(wait_until([&] { return test.window().jobs().running("tree"); }));
  test.window().open(folder / "tube.nrrd");
  ASSERT_TRUE(idle());
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_EQ(test.bench().image().volume->geometry.size[2], 110);
}

}  // namespace
}  // namespace ostia::workstation
