#pragma once
/// \file Long work on snapshots of the model, beside the editing.

#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"

#include <any>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ostia::session {

enum class JobState {
  waiting,
  running,
  done,        ///< the result waits to be taken
  failed,      ///< `message` says why
  cancelled,   ///< by `cancel`
  superseded,  ///< a newer job of its kind was submitted
};

struct JobStatus {
  JobState state = JobState::waiting;
  double progress = 0.0;  ///< [0, 1]
  std::string stage;      ///< what is being done now
  std::string message;    ///< of a failure
  bool finished() const { return state != JobState::waiting && state != JobState::running; }
};

/// Runs jobs in background threads, first come first served. Each works on an immutable snapshot, so editing
/// goes on meanwhile; where the processor is short, the window comes first. Nothing is called back: the
/// interface polls. Safe from any thread.
class WorkerQueue {
 public:
  using Snapshot = std::shared_ptr<const lumen::LumenModel>;
  /// May throw; ostia::Cancelled when the task says so.
  using Work = std::function<std::any(const lumen::LumenModel& model, const core::TaskContext& task)>;
  /// What needs no model, or brings what it needs with it.
  using PlainWork = std::function<std::any(const core::TaskContext& task)>;
  using JobId = std::int64_t;

  explicit WorkerQueue(int threads = 1);  ///< [1, 64]; throws InvalidInput
  /// Cancels all jobs and waits for those that run.
  ~WorkerQueue();
  WorkerQueue(const WorkerQueue&) = delete;
  WorkerQueue& operator=(const WorkerQueue&) = delete;

  /// The newest of a kind wins: a job of the same kind that waits or runs is superseded. Throws InvalidInput
  /// without a model or work.
  JobId submit(const std::string& kind, Snapshot snapshot, Work work);
  JobId submit(const std::string& kind, PlainWork work);
  /// Nothing for a job that was never submitted or was forgotten.
  std::optional<JobStatus> status(JobId job) const;
  void cancel(JobId job);  ///< a finished or unknown job stays as it is
  /// The result as the work returned it, once, of a job that is done; the job is forgotten with it.
  std::optional<std::any> take_any(JobId job);
  /// The same, as the type that it has.
  template <class Result>
  std::optional<Result> take(JobId job) {
    std::optional<std::any> result = take_any(job);
    if (!result) return std::nullopt;
    return std::any_cast<Result>(std::move(*result));
  }
  void forget(JobId job);  ///< cancels it, and drops its status and result

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::session
