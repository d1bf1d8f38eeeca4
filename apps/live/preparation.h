#pragma once
/// \file Work beside the window.

#include "ostia/core/task_context.h"

#include <chrono>
#include <functional>
#include <future>
#include <utility>

namespace ostia::live {

/// Runs a piece of work on a thread of its own from the start. Its end, in good time or not, cancels the work
/// and waits for it.
template <class Result>
class Preparation {
 public:
  using Work = std::function<Result(const core::TaskContext& task)>;
  explicit Preparation(Work work)
      : result_(
            std::async(std::launch::async, [work = std::move(work), task = task_] { return work(task); })) {}
  ~Preparation() { task_.cancel(); }  // the future's end waits
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Whether it is done, or has failed; waits so long at most.
  bool ready(std::chrono::milliseconds wait = {}) const {
    return result_.wait_for(wait) == std::future_status::ready;
  }
  /// What it came to, once, or what it threw; waits.
  Result get() { return result_.get(); }
  const core::TaskContext& task() const { return task_; }

 private:
  core::TaskContext task_;
  std::future<Result> result_;
};

}  // namespace ostia::live
