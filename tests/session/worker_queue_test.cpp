#include "ostia/session/worker_queue.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <thread>

namespace ostia::session {
namespace {

WorkerQueue::Snapshot snapshot() {
  static const auto model = std::make_shared<const lumen::LumenModel>(testing::tube_model());
  return model;
}

JobStatus finished(const WorkerQueue& queue, WorkerQueue::JobId job) {
  for (int i = 0; i < 20000; ++i) {
    const auto status = queue.status(job);
    if (!status) return {};
    if (status->finished()) return *status;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ADD_FAILURE() << "the job does not end";
  return {};
}

std::any until_cancelled(const core::TaskContext& task) {
  while (true) {
    task.throw_if_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(WorkerQueue, ResultsAreTakenOnce) {
  WorkerQueue queue(2);
  const auto job =
      queue.submit("count", snapshot(), [](const lumen::LumenModel& model, const core::TaskContext& task) {
        task.set_stage("counting");
        return std::any(model.vessels.size());
      });
  const JobStatus status = finished(queue, job);
  EXPECT_EQ(status.state, JobState::done);
  EXPECT_EQ(status.progress, 1.0);
  EXPECT_EQ(queue.take<std::size_t>(job), 1U);
  EXPECT_FALSE(queue.take<std::size_t>(job));
  EXPECT_FALSE(queue.status(job));
}

TEST(WorkerQueue, WorkWithoutAModelReturnsWhatItReturned) {
  WorkerQueue queue;
  const auto job = queue.submit("plain", [](const core::TaskContext& task) {
    task.set_progress(0.5);
    return std::any(std::string("made"));
  });
  EXPECT_EQ(finished(queue, job).state, JobState::done);
  const std::optional<std::any> result = queue.take_any(job);
  ASSERT_TRUE(result);
  EXPECT_EQ(std::any_cast<std::string>(*result), "made");
  EXPECT_FALSE(queue.take_any(job));
  EXPECT_THROW(queue.submit("plain", WorkerQueue::PlainWork()), InvalidInput);
}

TEST(WorkerQueue, WhatWorkHoldsOnToIsLetGoWhenItEnds) {
  WorkerQueue queue;
  auto held = std::make_shared<int>(7);
  const auto job =
      queue.submit("plain", [held](const core::TaskContext&) { return std::any(static_cast<int>(*held)); });
  EXPECT_EQ(finished(queue, job).state, JobState::done);
  EXPECT_EQ(held.use_count(), 1);
}

TEST(WorkerQueue, FailuresAreTold) {
  WorkerQueue queue;
  const auto job = queue.submit(
      "x", snapshot(), [](const auto&, const auto&) -> std::any { throw NumericalError("no convergence"); });
  const JobStatus status = finished(queue, job);
  EXPECT_EQ(status.state, JobState::failed);
  EXPECT_EQ(status.message, "no convergence");
  EXPECT_THROW(queue.submit("x", nullptr, [](const auto&, const auto&) { return std::any(); }), InvalidInput);
  EXPECT_THROW(WorkerQueue(0), InvalidInput);
}

TEST(WorkerQueue, TheNewestOfAKindWins) {
  WorkerQueue queue(1);
  std::latch running(1);
  std::atomic<int> ran{0};
  const auto first = queue.submit("wall", snapshot(), [&](const auto&, const core::TaskContext& task) {
    running.count_down();
    return until_cancelled(task);
  });
  running.wait();
  const auto work = [&](const auto&, const auto&) { return std::any(++ran); };
  const auto second = queue.submit("wall", snapshot(), work);
  const auto other = queue.submit("volume", snapshot(), work);
  const auto third = queue.submit("wall", snapshot(), work);
  EXPECT_EQ(queue.status(first)->state, JobState::superseded);
  EXPECT_EQ(finished(queue, third).state, JobState::done);
  EXPECT_EQ(finished(queue, other).state, JobState::done);
  const auto state = queue.status(second)->state;
  EXPECT_TRUE(state == JobState::superseded || state == JobState::done);  // it may have been quick
  EXPECT_LE(ran, 3);
}

TEST(WorkerQueue, CancelsWhatRunsAndWhatWaits) {
  WorkerQueue queue(1);
  std::latch running(1);
  const auto first = queue.submit("a", snapshot(), [&](const auto&, const core::TaskContext& task) {
    task.set_progress(0.5);
    running.count_down();
    return until_cancelled(task);
  });
  const auto second = queue.submit("b", snapshot(), [](const auto&, const auto&) { return std::any(1); });
  running.wait();
  EXPECT_EQ(queue.status(first)->progress, 0.5);
  queue.cancel(second);
  queue.cancel(first);
  EXPECT_EQ(finished(queue, first).state, JobState::cancelled);
  EXPECT_EQ(finished(queue, second).state, JobState::cancelled);
  EXPECT_FALSE(queue.take<int>(second));
}

TEST(WorkerQueue, ItsEndCancelsAndJoins) {
  std::atomic<bool> ended{false};
  {
    WorkerQueue queue(2);
    std::latch running(1);
    queue.submit("a", snapshot(), [&](const auto&, const core::TaskContext& task) -> std::any {
      running.count_down();
      try {
        until_cancelled(task);
      } catch (const Cancelled&) {
        ended = true;
        throw;
      }
      return {};
    });
    running.wait();
  }
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace ostia::session
