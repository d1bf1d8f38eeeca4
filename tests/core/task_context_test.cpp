#include "ostia/core/task_context.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace ostia::core {
namespace {

TEST(TaskContext, StartsAtZeroAndReachesOne) {
  const TaskContext task;
  EXPECT_EQ(task.progress(), 0.0);
  task.set_progress(1.0);
  EXPECT_EQ(task.progress(), 1.0);
}

TEST(TaskContext, ProgressNeverFalls) {
  const TaskContext task;
  task.set_progress(0.7);
  task.set_progress(0.3);
  EXPECT_DOUBLE_EQ(task.progress(), 0.7);
}

TEST(TaskContext, ClampsToItsRange) {
  const TaskContext task;
  task.set_progress(-3.0);
  EXPECT_EQ(task.progress(), 0.0);
  task.sub(0.2, 0.4).set_progress(9.0);
  EXPECT_DOUBLE_EQ(task.progress(), 0.4);
}

TEST(TaskContext, SubRangesNest) {
  const TaskContext task;
  const TaskContext half = task.sub(0.5, 1.0);
  const TaskContext quarter = half.sub(0.0, 0.5);
  quarter.set_progress(0.5);
  EXPECT_DOUBLE_EQ(task.progress(), 0.625);
  quarter.set_progress(1.0);
  EXPECT_DOUBLE_EQ(task.progress(), 0.75);
}

TEST(TaskContext, CancelReachesAllHandlesAndStays) {
  const TaskContext task;
  const TaskContext part = task.sub(0.0, 0.1);
  EXPECT_NO_THROW(task.throw_if_cancelled());
  part.cancel();
  EXPECT_TRUE(task.cancelled());
  EXPECT_THROW(task.throw_if_cancelled(), Cancelled);
  EXPECT_THROW(part.sub(0.5, 1.0).throw_if_cancelled(), Cancelled);
}

TEST(TaskContext, CancelIsSeenByAnotherThread) {
  const TaskContext task;
  bool seen = false;
  std::thread worker([&] {
    try {
      while (true) task.throw_if_cancelled();
    } catch (const Cancelled&) {
      seen = true;
    }
  });
  task.cancel();
  worker.join();
  EXPECT_TRUE(seen);
}

TEST(TaskContext, ManyThreadsReportTheFurthestProgress) {
  const TaskContext task;
  std::vector<std::thread> threads;
  for (int t = 1; t <= 4; ++t) {
    threads.emplace_back([&task, t] {
      for (int i = 0; i <= 1000; ++i) task.set_progress(i * 0.00025 * t);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_DOUBLE_EQ(task.progress(), 1.0);
}

TEST(TaskContext, StageIsSharedByAllHandles) {
  const TaskContext task;
  task.sub(0.0, 0.5).set_stage("level set");
  EXPECT_EQ(task.stage(), "level set");
}

TEST(TaskContext, NobodyWatchesNoTask) {
  no_task().set_progress(0.5);
  no_task().cancel();
  EXPECT_EQ(no_task().progress(), 0.0);
  EXPECT_FALSE(no_task().cancelled());
  EXPECT_NO_THROW(no_task().sub(0.0, 0.5).throw_if_cancelled());
}

}  // namespace
}  // namespace ostia::core
