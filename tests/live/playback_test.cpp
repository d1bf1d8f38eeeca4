#include "playback.h"

#include "made_ecg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::live {
namespace {

using ::testing::HasSubstr;

EcgFeed feed() {
  motion::MadeEcg ecg;
  ecg.beats(40, [](std::size_t) { return 0.75; });
  return EcgFeed(ecg.lead(), ecg.rate);
}

TEST(Playback, LoopsWithoutAnEcg) {
  Playback play(std::nullopt);
  EXPECT_FALSE(play.has_ecg());
  EXPECT_FALSE(play.follows_ecg());
  play.set_loop_interval(0.5);
  EXPECT_EQ(play.advance(0.1), 0U);
  EXPECT_NEAR(play.phase(), 0.2, 1e-12);
  play.set_speed(2.0);
  play.advance(0.2);
  EXPECT_NEAR(play.phase(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(play.interval_s(), 0.5);
  EXPECT_THAT(play.state().text, HasSubstr("loop"));
  EXPECT_EQ(play.signal().text, "");
}

TEST(Playback, FollowsTheEcgAtItsSpeed) {
  Playback play(feed(), 10.0);
  EXPECT_TRUE(play.follows_ecg());
  EXPECT_NEAR(play.interval_s(), 0.75, 0.01);
  const double before = play.phase();
  play.set_speed(0.5);
  EXPECT_NEAR(static_cast<double>(play.advance(0.3)), 0.15 * 360.0, 1.0);
  EXPECT_NEAR(std::remainder(play.phase() - before - 0.15 / 0.75, 1.0), 0.0, 0.01);
  EXPECT_EQ(play.state().text, "following the ECG");
  EXPECT_EQ(play.state().concern, Concern::none);
  EXPECT_EQ(play.signal().text, "signal good");
}

TEST(Playback, StandsStillWhereItIsPutAndGoesOnByTheEcg) {
  Playback play(feed(), 10.0);
  const double followed = play.phase();
  play.scrub(1.4);
  EXPECT_TRUE(play.paused());
  EXPECT_NEAR(play.phase(), 0.4, 1e-12);
  EXPECT_EQ(play.advance(5.0), 0U);
  EXPECT_NEAR(play.phase(), 0.4, 1e-12);
  EXPECT_THAT(play.state().text, HasSubstr("standing still"));
  play.pause(false);
  EXPECT_NEAR(play.phase(), followed, 1e-12) << "the stream stood still, too";
  play.pause(true);
  EXPECT_EQ(play.state().text, "paused");
}

TEST(Playback, ChangesBetweenEcgAndLoopWithoutAJump) {
  Playback play(feed(), 10.2);
  const double before = play.phase();
  play.follow_ecg(false);
  EXPECT_NEAR(play.phase(), before, 1e-12);
  play.follow_ecg(true);
  EXPECT_TRUE(play.follows_ecg());
  Playback none(std::nullopt);
  none.follow_ecg(true);
  EXPECT_FALSE(none.follows_ecg());
  none.seek(10.0);  // nothing to seek in
}

TEST(Playback, SaysWhatIsWrong) {
  Playback fresh(feed());
  EXPECT_THAT(fresh.state().text, HasSubstr("two beats"));
  Playback play(feed(), 25.0);
  play.advance(10.0);
  EXPECT_THAT(play.state().text, HasSubstr("coasting"));
  EXPECT_EQ(play.state().concern, Concern::trouble);
  EXPECT_EQ(play.signal().text, "the record has ended");
  play.seek(20.0);
  EXPECT_EQ(play.state().text, "following the ECG");
}

TEST(Playback, KeepsSpeedsInBounds) {
  Playback play(std::nullopt);
  play.set_speed(1e9);
  EXPECT_DOUBLE_EQ(play.speed(), 8.0);
  play.set_speed(0.0);
  EXPECT_DOUBLE_EQ(play.speed(), 0.05);
  play.set_loop_interval(100.0);
  EXPECT_DOUBLE_EQ(play.loop_interval_s(), 4.0);
}

}  // namespace
}  // namespace ostia::live
