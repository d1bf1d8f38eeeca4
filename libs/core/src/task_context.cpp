#include "ostia/core/task_context.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <utility>

namespace ostia::core {

struct TaskContext::State {
  std::atomic<double> progress{0.0};
  std::atomic<bool> cancelled{false};
  mutable std::mutex stage_mutex;
  std::string stage;
};

TaskContext::TaskContext() : state_(std::make_shared<State>()) {}

void TaskContext::set_progress(double fraction) const {
  if (!state_) return;
  const double wanted = from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0);
  double seen = state_->progress.load(std::memory_order_relaxed);
  while (seen < wanted && !state_->progress.compare_exchange_weak(seen, wanted, std::memory_order_relaxed)) {
  }
}

double TaskContext::progress() const {
  return state_ ? state_->progress.load(std::memory_order_relaxed) : 0.0;
}

void TaskContext::cancel() const {
  if (state_) state_->cancelled.store(true, std::memory_order_release);
}

bool TaskContext::cancelled() const {
  return state_ && state_->cancelled.load(std::memory_order_acquire);
}

void TaskContext::throw_if_cancelled() const {
  if (cancelled()) throw Cancelled();
}

void TaskContext::set_stage(std::string stage) const {
  if (!state_) return;
  const std::lock_guard lock(state_->stage_mutex);
  state_->stage = std::move(stage);
}

std::string TaskContext::stage() const {
  if (!state_) return {};
  const std::lock_guard lock(state_->stage_mutex);
  return state_->stage;
}

TaskContext TaskContext::sub(double from, double to) const {
  TaskContext part = *this;
  const double low = std::clamp(from, 0.0, 1.0);
  const double high = std::clamp(to, low, 1.0);
  part.from_ = from_ + (to_ - from_) * low;
  part.to_ = from_ + (to_ - from_) * high;
  return part;
}

const TaskContext& no_task() {
  static const TaskContext none{std::shared_ptr<TaskContext::State>()};
  return none;
}

}  // namespace ostia::core
