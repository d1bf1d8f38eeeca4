#include "ostia/core/job.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace ostia::core {
namespace {

thread_local const Job* job_of_thread = nullptr;

}  // namespace

struct Job::Heard {
  std::mutex mutex;
  std::vector<std::string> warnings;
};

Job::Job(TaskContext task) : task_(std::move(task)), heard_(std::make_shared<Heard>()) {}

std::vector<std::string> Job::warnings() const {
  const std::lock_guard lock(heard_->mutex);
  return heard_->warnings;
}

void Job::hear(std::string_view warning) const {
  const std::lock_guard lock(heard_->mutex);
  if (std::find(heard_->warnings.begin(), heard_->warnings.end(), warning) == heard_->warnings.end())
    heard_->warnings.emplace_back(warning);
}

JobHere::JobHere(const Job* job) : before_(std::exchange(job_of_thread, job)) {}

JobHere::~JobHere() {
  job_of_thread = before_;
}

const Job* current_job() {
  return job_of_thread;
}

void throw_if_job_cancelled() {
  if (job_of_thread != nullptr) job_of_thread->task().throw_if_cancelled();
}

}  // namespace ostia::core
