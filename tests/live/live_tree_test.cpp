// A vessel tree in the live viewer: what a click takes, what keys do, pictures without a window.

#include "live_program.h"

#include <gmock/gmock.h>

#include <fstream>

namespace ostia::live {
namespace {

using ::testing::HasSubstr;

struct LiveTreeGui : LiveProgramGui {
  // In the picture's plane from the front: a trunk up to the middle, two branches; the trunk is line 2.
  LiveTreeGui() {
    std::ofstream(folder / "y.swc") << "1 0 0 0 -10 2 -1\n2 0 0 0 0 2 1\n3 0 8 0 10 1 2\n4 0 -8 0 10 1 2\n";
  }
};

TEST_F(LiveTreeGui, AClickTakesWhatIsUnderIt) {
  REQUIRE_OPENGL();
  if (!has_xdotool()) GTEST_SKIP() << "xdotool is not installed";
  // The box's middle is the fork: the tree's scene is 774 of 1024 pixels wide.
  const std::string click = "xdotool mousemove --window $w ";
  const Outcome outcome =
      driven("y.swc --view AP", click + "387 470; sleep 0.4; xdotool click 1; sleep 0.4; " + click +
                                    "300 275; sleep 0.4; xdotool click 1; sleep 0.4");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto said = outcome.json();
  EXPECT_EQ(said["segments"], 3);
  ASSERT_EQ(said["picked"].size(), 2U);
  EXPECT_EQ(said["picked"][0]["reference"], 2);
  EXPECT_THAT((std::vector<int>{3, 4}), ::testing::Contains(said["picked"][1]["reference"].get<int>()));
}

TEST_F(LiveTreeGui, KeysShowASubtreeAndGoThere) {
  REQUIRE_OPENGL();
  if (!has_xdotool()) GTEST_SKIP() << "xdotool is not installed";
  const Outcome outcome = driven(
      "y.swc --view AP --pictures .",
      "xdotool mousemove --window $w 300 275; sleep 0.4; xdotool click 1; sleep 0.4; xdotool key t; sleep "
      "0.3; xdotool key f; sleep 0.3; xdotool key g; xdotool key r; sleep 0.3; xdotool key s; sleep 0.5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto said = outcome.json();
  EXPECT_EQ(said["shown"], 1);
  EXPECT_EQ(said["drawn"].get<int>(), 1);
  EXPECT_LT(said["distance_mm"].get<double>(), 50.0);  // of all: 0.55 * 25.6 / tan 15 = 52.6
  EXPECT_TRUE(fs::exists(folder / "ostia-live-0001.png"));
}

TEST_F(LiveTreeGui, PicturesNeedNoWindow) {
  REQUIRE_OPENGL();
  const Outcome one = live("y.swc --screenshot y.png --width 640 --height 480", "DISPLAY=");
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_GT(fs::file_size(folder / "y.png"), 2000U);
  const Outcome turn = live("y.swc --video v --frames 4 --width 640 --height 480 --no-panels", "DISPLAY=");
  EXPECT_EQ(turn.code, 0) << turn.err;
  EXPECT_TRUE(fs::exists(folder / "v" / "frame-00003.png"));
  EXPECT_NE(core::read_file(folder / "v" / "frame-00000.png"),
            core::read_file(folder / "v" / "frame-00001.png"));
  EXPECT_TRUE(fs::exists(folder / "v" / "manifest.json"));
}

TEST_F(LiveTreeGui, SaysWhatItDoesNotTake) {
  const Outcome ecg = live("y.swc --ecg 100.hea");
  EXPECT_EQ(ecg.code, 2);
  EXPECT_THAT(ecg.err, HasSubstr("--ecg"));
  std::ofstream(folder / "cut.swc") << "1 0 0 0 -10 2 -1\n2 0 0 ";
  const Outcome cut = live("cut.swc");
  EXPECT_EQ(cut.code, 3);
  EXPECT_THAT(cut.err, HasSubstr("cut.swc"));
}

}  // namespace
}  // namespace ostia::live
