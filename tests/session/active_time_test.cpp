#include "ostia/session/active_time.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

TEST(ActiveTime, CountsWhatIsDoneAndNotLongSilences) {
  double now = 100.0;
  ActiveTime time(60.0, [&] { return now; });
  now = 150.0;
  EXPECT_EQ(time.seconds(), 0.0);  // not started
  time.touch();
  EXPECT_EQ(time.seconds(), 0.0);
  time.start();
  now = 180.0;
  EXPECT_EQ(time.seconds(), 30.0);
  time.touch();
  now = 239.0;
  EXPECT_FALSE(time.idle());
  EXPECT_EQ(time.seconds(), 89.0);
  now = 1000.0;  // gone for long: the first minute counts
  EXPECT_TRUE(time.idle());
  EXPECT_EQ(time.seconds(), 90.0);
  time.touch();
  now = 1010.0;
  EXPECT_FALSE(time.idle());
  EXPECT_EQ(time.seconds(), 100.0);
}

TEST(ActiveTime, PausesAndBeginsAgain) {
  double now = 0.0;
  ActiveTime time(60.0, [&] { return now; });
  time.start();
  now = 10.0;
  time.pause();
  now = 50.0;
  EXPECT_FALSE(time.running());
  EXPECT_EQ(time.seconds(), 10.0);
  time.start();
  time.start();
  now = 55.0;
  EXPECT_EQ(time.seconds(), 15.0);
  time.reset();
  EXPECT_EQ(time.seconds(), 0.0);
  now = 57.0;
  EXPECT_EQ(time.seconds(), 2.0);
  EXPECT_THROW(ActiveTime(0.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
