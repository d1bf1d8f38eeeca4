// The program itself: its window under the X server's own keys and mouse (xdotool), its pictures without a
// window, what it says where something is missing.

#include "live_program.h"

#include "ostia/glview/sample_motion.h"
#include "ostia/io/cage_motion_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>

namespace ostia::live {
namespace {

using ::testing::HasSubstr;

TEST_F(LiveProgramGui, KeysDoWhatTheHelpSays) {
  REQUIRE_OPENGL();
  if (!has_xdotool()) GTEST_SKIP() << "xdotool is not installed";
  const std::string key = "xdotool key --delay 80 ";
  const Outcome outcome = driven("--demo --view AP --pictures .",
                                 key + "4; " + key + "x; " + key + "c c; " + key + "Up; " + key +
                                     "s; sleep 0.3; " + key + "space; " + key + "shift+Right; " + key + "h");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto said = outcome.json();
  EXPECT_NEAR(said["view"]["lao_deg"].get<double>(), -30.0, 1e-9);
  EXPECT_NEAR(said["view"]["cranial_deg"].get<double>(), -25.0, 1e-9);
  EXPECT_TRUE(said["view"]["x_ray"]);
  EXPECT_EQ(said["value"], "velocity, mm/s");
  EXPECT_NEAR(said["speed"].get<double>(), 1.25, 1e-9);
  EXPECT_TRUE(said["paused"]);
  EXPECT_THAT(said["state"].get<std::string>(), HasSubstr("standing still"));
  EXPECT_TRUE(said["help"]);
  EXPECT_EQ(said["screenshots"], 1);
  EXPECT_GT(fs::file_size(folder / "ostia-live-0001.png"), 10000U);
  EXPECT_GT(said["frames"].get<int>(), 20);
}

TEST_F(LiveProgramGui, AScreenshotThatCannotBeWrittenIsSaidAndTheWindowGoesOn) {
  REQUIRE_OPENGL();
  if (!has_xdotool()) GTEST_SKIP() << "xdotool is not installed";
  const Outcome outcome =
      driven("--demo --pictures /proc/nowhere", "xdotool key s; sleep 0.5; xdotool key x");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("nowhere"));
  EXPECT_TRUE(outcome.json()["view"]["x_ray"]);
}

TEST_F(LiveProgramGui, TheMouseTurnsMovesAndEnlarges) {
  REQUIRE_OPENGL();
  if (!has_xdotool()) GTEST_SKIP() << "xdotool is not installed";
  const std::string drag =
      "xdotool mousemove --window $w 300 400 mousedown 1; sleep 0.2; for i in 1 2 3 4 5 6; do xdotool "
      "mousemove_relative 10 0; sleep 0.05; done; xdotool mouseup 1; sleep 0.2; ";
  const Outcome turned = driven("--demo --view AP", drag + "xdotool click 4");
  ASSERT_EQ(turned.code, 0) << turned.err;
  const auto said = turned.json()["view"];
  EXPECT_NEAR(said["lao_deg"].get<double>(), -60.0 * 180.0 / 768.0, 3.0) << "60 px of 768 to the right";
  EXPECT_NEAR(said["cranial_deg"].get<double>(), 0.0, 0.5);
  const Outcome still = driven("--demo --view AP", "true");
  EXPECT_NEAR(said["half_height_mm"].get<double>() * 1.12,
              still.json()["view"]["half_height_mm"].get<double>(), 1e-6);
  // The panel's second button of views.
  const Outcome clicked =
      driven("--demo --view AP",
             "xdotool mousemove --window $w 957 271; sleep 0.2; xdotool mousedown 1; sleep 0.2; "
             "xdotool mouseup 1; sleep 0.2");
  EXPECT_NEAR(clicked.json()["view"]["lao_deg"].get<double>(), 30.0, 1e-9);
  EXPECT_NEAR(clicked.json()["view"]["cranial_deg"].get<double>(), 20.0, 1e-9);
}

TEST_F(LiveProgramGui, EndsByItselfAndOnASignal) {
  REQUIRE_OPENGL();
  const Outcome timed = live("--demo --measure --seconds 1");
  EXPECT_EQ(timed.code, 0) << timed.err;
  EXPECT_GT(timed.json()["frames"].get<int>(), 3);
  const Outcome asked =
      shell("\"$live\" --demo --measure --seconds 30 & p=$!; sleep 2; kill -TERM $p; wait $p");
  EXPECT_EQ(asked.code, 128 + SIGTERM) << asked.err;
  EXPECT_GT(asked.json()["frames"].get<int>(), 3);
}

TEST_F(LiveProgramGui, TheWindowShowsWhatItWaitsForAndCanBeEndedMeanwhile) {
  REQUIRE_OPENGL();
  const Outcome shown = live("--demo --measure --seconds 0.5");
  ASSERT_EQ(shown.code, 0) << shown.err;
  const double first = shown.json()["first_picture_s"], prepared = shown.json()["prepared_s"];
  EXPECT_GT(first, 0.0);
  EXPECT_LT(first, prepared) << "before the heart is there";
  // A motion that does not come: the window waits for it until it is asked to end.
  const Outcome ended = shell(
      "mkfifo slow.json; \"$live\" slow.json & p=$!; sleep 2; kill -TERM $p; sleep 0.5; printf '{}' > "
      "slow.json; wait $p");
  EXPECT_EQ(ended.code, 128 + SIGTERM) << ended.err;
  const Outcome wrong =
      shell("mkfifo wrong.json; \"$live\" wrong.json & p=$!; sleep 1; printf '{}' > wrong.json; wait $p");
  EXPECT_EQ(wrong.code, 3) << "what cannot be read ends a window that waits for it";
  EXPECT_THAT(wrong.err, HasSubstr("wrong.json"));
}

TEST_F(LiveProgramGui, ColoursComeWhenTheyAreAskedFor) {
  REQUIRE_OPENGL();
  ASSERT_EQ(live("--demo --phase 38 --screenshot plain.png").code, 0);
  for (const char* color : {"velocity", "stretch", "curvature"}) {
    const std::string file = std::string(color) + ".png";
    const Outcome outcome = live(std::string("--demo --phase 38 --color ") + color + " --screenshot " + file);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(core::read_file(folder / file), core::read_file(folder / "plain.png")) << color;
  }
}

TEST_F(LiveProgramGui, PicturesNeedNoDisplayAndAreTheSameEachTime) {
  REQUIRE_OPENGL();
  const std::string no_display = "env -u DISPLAY";
  for (const char* name : {"a", "b"}) {
    const Outcome outcome = live(std::string("--demo --phase 38 --screenshot ") + name + ".png", no_display);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  ASSERT_EQ(live("--demo --phase 75 --screenshot c.png", no_display).code, 0);
  EXPECT_EQ(core::read_file(folder / "a.png"), core::read_file(folder / "b.png"));
  EXPECT_NE(core::read_file(folder / "a.png"), core::read_file(folder / "c.png"));
}

TEST_F(LiveProgramGui, AVideoIsItsPicturesAndAFilmWhereFfmpegIs) {
  REQUIRE_OPENGL();
  const Outcome outcome = live("--demo --video film --frames 6 --width 321 --height 241");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (int k = 0; k < 6; ++k)
    EXPECT_TRUE(fs::exists(folder / "film" / ("frame-0000" + std::to_string(k) + ".png")));
  EXPECT_NE(core::read_file(folder / "film" / "frame-00001.png"),
            core::read_file(folder / "film" / "frame-00004.png"));
  const bool has_ffmpeg = std::system("command -v ffmpeg > /dev/null 2>&1") == 0;
  EXPECT_EQ(fs::exists(folder / "film" / "video.mp4"), has_ffmpeg);
  const Outcome without = live("--demo --video plain --frames 2", "env PATH=/nowhere");
  EXPECT_EQ(without.code, 0);
  EXPECT_FALSE(fs::exists(folder / "plain" / "video.mp4"));
  EXPECT_TRUE(fs::exists(folder / "plain" / "frame-00001.png"));
}

TEST_F(LiveProgramGui, AVideoTakesNoFolderWithOtherThings) {
  REQUIRE_OPENGL();
  fs::create_directories(folder / "beats");
  core::write_file(folder / "beats" / "mine", "kept");
  const Outcome refused = live("--demo --video beats --frames 2");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("beats"));
  EXPECT_EQ(core::read_file(folder / "beats" / "mine"), "kept");
  EXPECT_FALSE(fs::exists(folder / "beats" / "frame-00000.png"));
  fs::remove(folder / "beats" / "mine");
  for (const int frames : {3, 2}) {  // an earlier video is replaced
    const Outcome outcome =
        live("--demo --video beats --width 320 --height 240 --frames " + std::to_string(frames));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder / "beats" / "frame-00002.png"));
  const auto manifest = nlohmann::json::parse(core::read_file(folder / "beats" / "manifest.json"));
  EXPECT_TRUE(manifest["outputs"].contains("frame-00001.png"));
  EXPECT_EQ(manifest["parameters"]["frames"], 2);
}

TEST_F(LiveProgramGui, ShowsAMotionOfAFileAndGoesOnWithoutABadEcg) {
  REQUIRE_OPENGL();
  const glview::SampleHeart heart = glview::sample_heart(1.5, 2);
  fs::create_directories(folder / "motion");
  io::write_surface(folder / "motion" / "template.vtp", heart.surface);
  io::write_cage_motion(folder / "motion" / "motion.json", {heart.motion, "template.vtp"});
  EXPECT_EQ(live("motion --screenshot a.png --phase 10").code, 0);
  core::write_file(folder / "bad.hea", "this is no header\n");
  const Outcome bad = live("motion --ecg bad.hea --screenshot b.png --phase 10");
  EXPECT_EQ(bad.code, 4) << "a person must look";
  EXPECT_THAT(bad.err, HasSubstr("bad.hea"));
  EXPECT_THAT(bad.err, HasSubstr("without an electrocardiogram"));
  EXPECT_TRUE(fs::exists(folder / "b.png"));
}

TEST_F(LiveProgramGui, ExitCodesAndWords) {
  EXPECT_EQ(live("--help").code, 0);
  EXPECT_THAT(live("--version").out, HasSubstr("ostia-live "));
  EXPECT_EQ(live("").code, 2);
  EXPECT_THAT(live("--demo --view up").err, HasSubstr("LAO30CRA20"));
  const Outcome missing = live("nowhere.json --screenshot a.png");
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("nowhere.json"));
  const Outcome no_display = live("--demo --seconds 1", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(no_display.code, 5);
  EXPECT_THAT(no_display.err, HasSubstr("no display"));
  const Outcome old = live("--demo --seconds 1", "env LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=2.1");
  EXPECT_EQ(old.code, 5);
  EXPECT_THAT(old.err, HasSubstr("OpenGL 3.3"));
  EXPECT_THAT(old.err, HasSubstr("LIBGL_ALWAYS_SOFTWARE=1"));
  const Outcome old_picture =
      live("--demo --screenshot a.png", "env LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=2.1");
  EXPECT_EQ(old_picture.code, 5);
  EXPECT_THAT(old_picture.err, HasSubstr("OpenGL 3.3"));
}

TEST_F(LiveProgramGui, AFolderThatIsNotThereIsSaid) {
  REQUIRE_OPENGL();
  const Outcome outcome = live("--demo --phase 5 --screenshot /proc/nowhere/a.png");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere"));
}

}  // namespace
}  // namespace ostia::live
