#pragma once
/// \file Work that runs beside its owner.

#include "ostia/core/job.h"
#include "ostia/core/task_context.h"

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <utility>

namespace ostia::core {

/// Begins at once in a thread of its own; is cancelled, and waited for, when the handle goes.
template <class T>
class BackgroundTask {
 public:
  using Work = std::function<T(const TaskContext& task)>;
  explicit BackgroundTask(Work work)
      : result_(std::async(std::launch::async, [task = task_, work = std::move(work), job = job_here()] {
          const JobHere here(job ? &*job : nullptr);
          return work(task);
        })) {}
  ~BackgroundTask() { task_.cancel(); }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Waits for the result, once, with the work's progress shown in `task`. Throws what the work threw, and
  /// ostia::Cancelled when `task` is cancelled.
  T get(const TaskContext& task = no_task()) {
    constexpr std::chrono::milliseconds look_again{10};
    while (result_.wait_for(look_again) != std::future_status::ready) {
      task.throw_if_cancelled();
      task.set_progress(task_.progress());
    }
    return result_.get();
  }

 private:
  /// A copy: this may outlive the thread's own.
  static std::optional<Job> job_here() {
    return current_job() != nullptr ? std::optional<Job>(*current_job()) : std::nullopt;
  }
  TaskContext task_;
  std::future<T> result_;
};

}  // namespace ostia::core
