#include "ostia/core/background_task.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace ostia::core {
namespace {

void wait_for(const std::atomic<bool>& what) {
  while (!what) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(BackgroundTask, BeginsAtOnceAndGivesItsResultAndProgress) {
  std::atomic<bool> begun = false, go_on = false;
  BackgroundTask<std::unique_ptr<int>> work([&](const TaskContext& task) {
    task.set_progress(0.5);
    begun = true;
    wait_for(go_on);
    return std::make_unique<int>(7);
  });
  wait_for(begun);
  const TaskContext shown;
  std::thread watch([&] {
    while (shown.progress() < 0.5) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    go_on = true;
  });
  EXPECT_EQ(*work.get(shown), 7);
  watch.join();
}

TEST(BackgroundTask, ThrowsWhatTheWorkThrew) {
  BackgroundTask<int> work([](const TaskContext&) -> int { throw InvalidInput("no"); });
  EXPECT_THROW(work.get(), InvalidInput);
}

TEST(BackgroundTask, IsCancelledAndWaitedForWhenItGoes) {
  std::atomic<bool> begun = false, ended = false;
  {
    const BackgroundTask<int> work([&](const TaskContext& task) {
      begun = true;
      while (!task.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ended = true;
      return 0;
    });
    wait_for(begun);
    EXPECT_FALSE(ended);
  }
  EXPECT_TRUE(ended);
}

TEST(BackgroundTask, WhoWaitsCanGiveUp) {
  BackgroundTask<int> work([](const TaskContext& task) {
    while (true) {
      task.throw_if_cancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return 0;
  });
  const TaskContext waiting;
  waiting.cancel();
  EXPECT_THROW(work.get(waiting), Cancelled);
}

}  // namespace
}  // namespace ostia::core
