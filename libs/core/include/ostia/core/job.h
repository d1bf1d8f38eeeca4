#pragma once
/// \file Whom the calling thread works for: what functions know of it that are handed no TaskContext.

#include "ostia/core/task_context.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::core {

/// A piece of work that somebody has asked for and waits for. Copies are the same job. A warning that is
/// logged while a thread works for it is heard by it, beside all that HeardWarnings hears. Once its task is
/// cancelled no file or folder that is under construction appears any more (StagedFile, StagedFolder).
class Job {
 public:
  explicit Job(TaskContext task = {});
  const TaskContext& task() const { return task_; }
  /// Heard so far, each once; any thread.
  std::vector<std::string> warnings() const;
  void hear(std::string_view warning) const;

 private:
  struct Heard;
  TaskContext task_;
  std::shared_ptr<Heard> heard_;
};

/// The calling thread works for a job (null: for none) while this lives; so do the bodies of its parallel
/// loops and its BackgroundTasks. The innermost counts. The job outlives it.
class JobHere {
 public:
  explicit JobHere(const Job* job);
  ~JobHere();
  JobHere(const JobHere&) = delete;
  JobHere& operator=(const JobHere&) = delete;

 private:
  const Job* before_;
};
/// Null where the calling thread works for none.
const Job* current_job();
/// Throws Cancelled where the calling thread's job is cancelled.
void throw_if_job_cancelled();

}  // namespace ostia::core
