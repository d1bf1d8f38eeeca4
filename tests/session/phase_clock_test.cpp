#include "ostia/session/phase_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::session {
namespace {

TEST(PhaseClock, GoesAroundAtTheHeartsPace) {
  PhaseClock clock;
  clock.pass(10.0);
  EXPECT_DOUBLE_EQ(clock.percent.get(), 0.0) << "it does not play";
  clock.toggle();
  clock.beats_a_minute.set(120.0);
  clock.pass(0.125);
  EXPECT_NEAR(clock.percent.get(), 25.0, 1e-9);
  clock.pass(0.5);
  EXPECT_NEAR(clock.percent.get(), 25.0, 1e-9) << "a whole beat later";
  clock.pass(0.4);
  EXPECT_NEAR(clock.percent.get(), 5.0, 1e-9);
  EXPECT_TRUE(clock.playing.get());
  EXPECT_NEAR(clock.phase(), 0.05, 1e-9);
}

TEST(PhaseClock, StopsAtTheEndWhereItDoesNotLoopAndBeginsAnew) {
  PhaseClock clock;
  clock.loop.set(false);
  clock.percent.set(90.0);
  clock.toggle();
  clock.pass(5.0);
  EXPECT_DOUBLE_EQ(clock.percent.get(), 100.0);
  EXPECT_FALSE(clock.playing.get());
  EXPECT_DOUBLE_EQ(clock.phase(), 0.0) << "the next beat's";
  clock.toggle();
  EXPECT_DOUBLE_EQ(clock.percent.get(), 0.0);
  EXPECT_TRUE(clock.playing.get());
  clock.toggle();
  EXPECT_FALSE(clock.playing.get());
}

TEST(PhaseClock, TimeThatIsNoneIsRefused) {
  PhaseClock clock;
  clock.toggle();
  EXPECT_THROW(clock.pass(-1.0), InvalidInput);
  EXPECT_THROW(clock.pass(std::nan("")), InvalidInput);
  EXPECT_DOUBLE_EQ(clock.percent.get(), 0.0);
}

}  // namespace
}  // namespace ostia::session
