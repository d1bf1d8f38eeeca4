#include "call.h"

#include "ostia/core/error.h"
#include "ostia/core/job.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>

namespace ostia::python {
namespace {

constexpr std::chrono::milliseconds between_looks{50}, patience{100};

/// All calls that are on their way, in any thread, and work that was left.
class Calls {
 public:
  /// False when Python ends: the call is none of them, and keeps the interpreter's lock.
  bool begin(const core::TaskContext* task) {
    const std::lock_guard lock(mutex_);
    if (ending_) return false;
    ++count_;
    if (task != nullptr) tasks_.insert(task);
    return true;
  }
  void end(const core::TaskContext* task) {
    const std::lock_guard lock(mutex_);
    --count_;
    if (task != nullptr) tasks_.erase(task);
    wake_.notify_all();
  }
  /// Python ends in another thread.
  bool ended_elsewhere() {
    const std::lock_guard lock(mutex_);
    return ending_ && ender_ != std::this_thread::get_id();
  }
  void end_all() {
    std::unique_lock lock(mutex_);
    ending_ = true;
    ender_ = std::this_thread::get_id();
    for (const core::TaskContext* task : tasks_) task->cancel();
    wake_.wait(lock, [this] { return count_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  std::set<const core::TaskContext*> tasks_;
  int count_ = 0;
  bool ending_ = false;
  std::thread::id ender_;
};

Calls& calls() {
  static auto* all = new Calls;  // never gone: threads may still ask it
  return *all;
}

/// A thread that Python does not wait for may not come back to it when it has ended: where it next gave up
/// the interpreter's lock, in whatever runs there, Python would end the thread through frames of C++, whose
/// objects are then let go of without the lock. It stays here instead, until the process is gone (as Python
/// itself does from 3.14 on).
void stay_where_python_ends() {
  if (!calls().ended_elsewhere()) return;
  const py::gil_scoped_release released;
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// With the interpreter's lock, from its beginning to its end.
class InCall {
 public:
  explicit InCall(const core::TaskContext* task) : task_(task), counted_(calls().begin(task)) {
    if (!counted_) stay_where_python_ends();
  }
  ~InCall() {
    if (!counted_) return;
    calls().end(task_);
    stay_where_python_ends();
  }
  InCall(const InCall&) = delete;
  InCall& operator=(const InCall&) = delete;
  bool counted() const { return counted_; }

 private:
  const core::TaskContext* task_;
  bool counted_;
};

/// Work with its job, and whether it is done.
class Running {
 public:
  explicit Running(Work work) : work_(std::move(work)) {}
  const core::TaskContext& task() const { return job_.task(); }
  std::vector<std::string> warnings() const { return job_.warnings(); }
  void run() {
    std::exception_ptr failure;
    try {
      const core::JobHere here(&job_);
      work_(job_.task());
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    failure_ = failure;
    done_ = true;
    wake_.notify_one();
  }
  /// Waits a while without the interpreter's lock.
  bool done_within(std::chrono::milliseconds time) {
    const py::gil_scoped_release released;
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, time, [this] { return done_; });
  }
  std::exception_ptr failure() const { return failure_; }

 private:
  core::Job job_;
  Work work_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::exception_ptr failure_;
};

/// The thread of it. Ends it, unless it was left.
class Worker {
 public:
  explicit Worker(std::shared_ptr<Running> running)
      : running_(std::move(running)), thread_([running = running_] { running->run(); }) {}
  ~Worker() {
    if (!thread_.joinable()) return;
    running_->task().cancel();  // where it is done, nobody asks any more
    const py::gil_scoped_release released;
    thread_.join();
  }
  /// It goes on by itself, counted until it has let go of all that it holds; false when Python ends.
  bool leave() {
    if (!calls().begin(nullptr)) return false;
    std::thread last([running = std::move(running_), thread = std::move(thread_)]() mutable {
      thread.join();
      running.reset();
      calls().end(nullptr);
    });
    last.detach();
    return true;
  }

 private:
  std::shared_ptr<Running> running_;
  std::thread thread_;  // last: it uses the other
};

py::object teller(const py::object& progress) {
  if (progress.is_none() || progress.is(py::bool_(false))) return py::none();
  if (progress.is(py::bool_(true))) return py::module_::import("ostia._progress").attr("Bar")();
  if (PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("progress: a callable that takes (fraction, stage), True for a bar, or None");
  return progress;
}

void look(const core::TaskContext& task, const py::object& tell) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!tell.is_none()) tell(task.progress(), task.stage());
}

/// A bar of ours is closed; what a caller gave is the caller's.
void end_bar(const py::object& progress, const py::object& tell) {
  if (progress.is(py::bool_(true))) tell.attr("close")();
}

void hand_on(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings)
    py::module_::import("logging").attr("getLogger")("ostia").attr("warning")("%s", text);
}

/// What was raised here while the work ran, and what it threw itself.
struct Outcome {
  std::optional<py::error_already_set> raised;
  std::exception_ptr failure;
};

/// `may_be_left`: after an interrupt, if it does not end soon.
Outcome outcome_of(const std::shared_ptr<Running>& running, const py::object& tell, bool may_be_left) {
  Outcome out;
  Worker worker(running);
  while (!running->done_within(out.raised && may_be_left ? patience : between_looks)) {
    if (out.raised && may_be_left && worker.leave()) return out;
    if (out.raised) continue;
    try {
      look(running->task(), tell);
    } catch (py::error_already_set& error) {
      out.raised.emplace(error);
      running->task().cancel();
    }
  }
  out.failure = running->failure();
  return out;
}

void run(const py::object& progress, Work work, bool may_be_left) {
  const py::object tell = teller(progress);
  const auto running = std::make_shared<Running>(std::move(work));
  const InCall call(&running->task());
  Outcome out;
  if (call.counted()) {
    out = outcome_of(running, tell, may_be_left);
  } else {
    running->run();
    out.failure = running->failure();
  }
  try {
    end_bar(progress, tell);
    hand_on(running->warnings());
  } catch (const py::error_already_set&) {
    if (!out.raised && !out.failure) throw;  // else it would take the place of what went wrong first
  }
  if (out.raised) throw *out.raised;
  if (out.failure) std::rethrow_exception(out.failure);
}

}  // namespace

void run_watched(const py::object& progress, const Work& work) {
  run(
      progress, [&work](const core::TaskContext& task) { work(task); }, false);
}

void run_left(const py::object& progress, Work work) {
  run(progress, std::move(work), true);
}

void run_unlocked(const std::function<void()>& work) {
  const core::Job job;
  const InCall call(nullptr);
  std::exception_ptr failure;
  {
    std::optional<py::gil_scoped_release> released;
    if (call.counted()) released.emplace();
    const core::JobHere here(&job);
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  }
  try {
    hand_on(job.warnings());
  } catch (const py::error_already_set&) {
    if (!failure) throw;
  }
  if (failure) std::rethrow_exception(failure);
}

void end_all_calls() {
  const py::gil_scoped_release released;
  calls().end_all();
}

}  // namespace ostia::python
