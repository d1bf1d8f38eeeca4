#include "ostia/session/worker_queue.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <condition_variable>
#include <exception>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace ostia::session {
namespace {

struct Job {
  std::string kind;
  WorkerQueue::PlainWork work;  // holds the snapshot where there is one
  core::TaskContext task;
  JobState state = JobState::waiting;
  std::string message;
  std::any result;
};

bool is_open(const Job& job) {
  return job.state == JobState::waiting || job.state == JobState::running;
}

}  // namespace

struct WorkerQueue::Impl {
  mutable std::mutex mutex;
  std::condition_variable wake;
  std::map<JobId, std::shared_ptr<Job>> jobs;
  std::list<std::shared_ptr<Job>> waiting;
  std::vector<std::thread> threads;
  JobId next = 1;
  bool stopping = false;

  /// With the lock held: the job's end as the outside sees it, at once; its thread notices later.
  void end(const std::shared_ptr<Job>& job, JobState state) {
    if (!is_open(*job)) return;
    if (job->state == JobState::waiting) waiting.remove(job);
    job->state = state;
    job->task.cancel();
  }

  void loop() {
    core::lower_thread_priority();
    std::unique_lock lock(mutex);
    while (true) {
      wake.wait(lock, [&] { return stopping || !waiting.empty(); });
      if (stopping) return;
      const std::shared_ptr<Job> job = waiting.front();
      waiting.pop_front();
      job->state = JobState::running;
      lock.unlock();
      std::any result;
      std::string message;
      JobState state = JobState::done;
      try {
        result = job->work(job->task);
      } catch (const Cancelled&) {
        state = JobState::cancelled;
      } catch (const std::exception& e) {
        state = JobState::failed;
        message = e.what();
      } catch (...) {
        state = JobState::failed;
        message = "an unknown failure";
      }
      // What the work holds on to is let go outside the lock: it may be a folder of files to delete, and who
      // asks for a state must not wait for it.
      { const PlainWork work = std::exchange(job->work, {}); }
      lock.lock();
      if (job->state != JobState::running) {  // cancelled or superseded meanwhile
        lock.unlock();
        result.reset();
        lock.lock();
        continue;
      }
      job->state = state;
      job->message = std::move(message);
      job->result = std::move(result);
    }
  }
};

WorkerQueue::WorkerQueue(int threads) : impl_(std::make_unique<Impl>()) {
  if (threads < 1 || threads > 64)
    throw InvalidInput("a worker queue of " + std::to_string(threads) + " threads; choose 1 to 64");
  core::start_loop_threads();
  for (int i = 0; i < threads; ++i) impl_->threads.emplace_back([this] { impl_->loop(); });
}

WorkerQueue::~WorkerQueue() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->stopping = true;
    for (auto& [id, job] : impl_->jobs) impl_->end(job, JobState::cancelled);
  }
  impl_->wake.notify_all();
  for (std::thread& thread : impl_->threads) thread.join();
}

WorkerQueue::JobId WorkerQueue::submit(const std::string& kind, Snapshot snapshot, Work work) {
  if (!snapshot || !work) throw InvalidInput("the job \"" + kind + "\" needs a model and something to do");
  return submit(kind, [snapshot = std::move(snapshot), work = std::move(work)](
                          const core::TaskContext& task) { return work(*snapshot, task); });
}

WorkerQueue::JobId WorkerQueue::submit(const std::string& kind, PlainWork work) {
  if (!work) throw InvalidInput("the job \"" + kind + "\" needs something to do");
  auto job = std::make_shared<Job>();
  job->kind = kind;
  job->work = std::move(work);
  JobId id = 0;
  {
    const std::lock_guard lock(impl_->mutex);
    for (auto& [other, old] : impl_->jobs)
      if (old->kind == kind) impl_->end(old, JobState::superseded);
    id = impl_->next++;
    impl_->jobs.emplace(id, job);
    impl_->waiting.push_back(job);
  }
  impl_->wake.notify_one();
  return id;
}

std::optional<JobStatus> WorkerQueue::status(JobId id) const {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->jobs.find(id);
  if (found == impl_->jobs.end()) return std::nullopt;
  const Job& job = *found->second;
  return JobStatus{job.state, job.state == JobState::done ? 1.0 : job.task.progress(), job.task.stage(),
                   job.message};
}

void WorkerQueue::cancel(JobId id) {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->jobs.find(id);
  if (found != impl_->jobs.end()) impl_->end(found->second, JobState::cancelled);
}

void WorkerQueue::forget(JobId id) {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->jobs.find(id);
  if (found == impl_->jobs.end()) return;
  impl_->end(found->second, JobState::cancelled);
  impl_->jobs.erase(found);
}

std::optional<std::any> WorkerQueue::take_any(JobId id) {
  const std::lock_guard lock(impl_->mutex);
  const auto found = impl_->jobs.find(id);
  if (found == impl_->jobs.end() || found->second->state != JobState::done) return std::nullopt;
  std::any result = std::move(found->second->result);
  impl_->jobs.erase(found);
  return result;
}

}  // namespace ostia::session
