#include "frame_meter.h"

#include <gtest/gtest.h>

namespace ostia::live {
namespace {

TEST(FrameMeter, CountsPicturesAndAges) {
  FrameMeter meter;
  EXPECT_DOUBLE_EQ(meter.frames_per_second(), 0.0);
  EXPECT_EQ(meter.latency_ms().count, 0U);
  // A picture each 10 ms, each with three samples 2 ms apart, the newest 5 ms old when it is shown.
  for (int k = 0; k <= 200; ++k) {
    const double t = 3.0 + 0.01 * k;
    meter.shown(t, 3, t - 0.005, 0.002);
  }
  EXPECT_NEAR(meter.frames_per_second(), 100.0, 1e-6);
  EXPECT_NEAR(meter.recent_frames_per_second(), 100.0, 1.1);
  EXPECT_NEAR(meter.frame_ms().p95, 10.0, 1e-6);
  EXPECT_EQ(meter.latency_ms().count, 603U);
  EXPECT_NEAR(meter.latency_ms().p50, 7.0, 1e-6);
  EXPECT_NEAR(meter.latency_ms().max, 9.0, 1e-6);
}

TEST(FrameMeter, KeepsOneSecondAloneWhereNothingIsMeasured) {
  FrameMeter meter(false);
  for (int k = 0; k <= 5000; ++k) meter.shown(0.01 * k, 3, 0.01 * k, 0.002);
  EXPECT_LE(meter.frames(), 102U);
  EXPECT_EQ(meter.latency_ms().count, 0U);
  EXPECT_NEAR(meter.recent_frames_per_second(), 100.0, 1.1);
}

}  // namespace
}  // namespace ostia::live
