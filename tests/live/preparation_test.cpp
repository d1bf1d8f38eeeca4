#include "preparation.h"

#include "live_heart.h"
#include "start_clock.h"
#include "surface_colors.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace ostia::live {
namespace {

using glview::SurfaceValue;
using std::chrono::milliseconds;

TEST(Preparation, GivesWhatTheWorkCameToAndHowFarItIs) {
  std::atomic<bool> may_end = false;
  Preparation<int> work([&](const core::TaskContext& task) {
    task.set_stage("counting");
    task.set_progress(0.5);
    while (!may_end) std::this_thread::sleep_for(milliseconds(1));
    return 42;
  });
  while (work.task().progress() < 0.5) std::this_thread::sleep_for(milliseconds(1));
  EXPECT_EQ(work.task().stage(), "counting");
  EXPECT_FALSE(work.ready());
  may_end = true;
  EXPECT_EQ(work.get(), 42);
}

TEST(Preparation, ThrowsWhatTheWorkThrew) {
  Preparation<int> work([](const core::TaskContext&) -> int { throw InvalidInput("a bad file"); });
  EXPECT_THROW(work.get(), InvalidInput);
}

TEST(Preparation, ItsEndCancelsTheWorkAndWaits) {
  std::atomic<bool> cancelled = false;
  {
    const Preparation<int> work([&](const core::TaskContext& task) {
      while (!task.cancelled()) std::this_thread::sleep_for(milliseconds(1));
      cancelled = true;
      return 0;
    });
  }
  EXPECT_TRUE(cancelled);
}

TEST(StartClock, GoesOnFromTheStartOfTheProcess) {
  const double before = seconds_since_start();
  EXPECT_GE(before, 0.0);
  EXPECT_LT(before, 3600.0);
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_GE(seconds_since_start(), before + 0.029);
}

TEST(LiveHeart, IsReadyToBeDrawnAndEndsWhenItIsCancelled) {
  const LiveHeart heart = read_heart({});
  EXPECT_EQ(heart.surface.vertices.size(), heart.input.surface.points.size());
  EXPECT_TRUE(heart.surface.closed);
  EXPECT_EQ(heart.places.size(), 10 * heart.input.surface.points.size());
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(read_heart({}, task), Cancelled);
}

TEST(SurfaceColors, FindsWhatEachColourNeedsAndOneAfterTheOther) {
  const LiveHeart heart = read_heart({});
  SurfaceColors colors(heart.surface, heart.cage);
  EXPECT_FALSE(colors.busy());
  EXPECT_FALSE(colors.ready());
  colors.ask(SurfaceValue::displacement);
  colors.ask(SurfaceValue::stretch);  // it is busy with the first
  const SurfaceColors::Found first = colors.take();
  EXPECT_EQ(first.value, SurfaceValue::displacement);
  EXPECT_TRUE(first.along.empty());
  EXPECT_GT(first.range.high, 3.0) << "the sample heart moves by some millimetres";
  EXPECT_FALSE(colors.busy());
  colors.ask(SurfaceValue::bending);
  const SurfaceColors::Found last = colors.take();
  EXPECT_EQ(last.along.size(), heart.surface.vertices.size());
  ASSERT_TRUE(last.bending);
  EXPECT_EQ(last.bending->values.size(), 20 * heart.surface.vertices.size());
  EXPECT_DOUBLE_EQ(last.range.low, -last.range.high);
}

}  // namespace
}  // namespace ostia::live
