#include "call.h"

#include "ostia/core/log.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace ostia::python {
namespace {

constexpr std::chrono::milliseconds between_looks{50};

/// The thread that works, and whether it is done.
class Worker {
 public:
  explicit Worker(const std::function<void(const core::TaskContext&)>& work)
      : thread_([this, &work] { run(work); }) {}
  ~Worker() {
    task_.cancel();  // where it is done, nobody asks any more
    const py::gil_scoped_release released;
    thread_.join();
  }
  const core::TaskContext& task() const { return task_; }
  /// Waits a while without the interpreter's lock.
  bool done_soon() {
    const py::gil_scoped_release released;
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, between_looks, [this] { return done_; });
  }
  std::exception_ptr failure() const { return failure_; }

 private:
  void run(const std::function<void(const core::TaskContext&)>& work) {
    std::exception_ptr failure;
    try {
      work(task_);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    failure_ = failure;
    done_ = true;
    wake_.notify_one();
  }

  core::TaskContext task_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::exception_ptr failure_;
  std::thread thread_;  // last: it uses all others
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

void hand_warnings_on() {
  for (const std::string& text : core::heard_warnings())
    py::module_::import("logging").attr("getLogger")("ostia").attr("warning")("%s", text);
}

}  // namespace

void run_watched(const py::object& progress, const std::function<void(const core::TaskContext&)>& work) {
  const py::object tell = teller(progress);
  const core::HeardWarnings heard;
  std::optional<py::error_already_set> raised;
  std::exception_ptr failure;
  {
    Worker worker(work);
    while (!worker.done_soon()) {
      if (raised) continue;
      try {
        look(worker.task(), tell);
      } catch (py::error_already_set& error) {
        raised.emplace(error);
        worker.task().cancel();
      }
    }
    failure = worker.failure();
  }
  try {
    end_bar(progress, tell);
    hand_warnings_on();
  } catch (const py::error_already_set&) {
    if (!raised && !failure) throw;  // else it would take the place of what went wrong first
  }
  if (raised) throw *raised;
  if (failure) std::rethrow_exception(failure);
}

}  // namespace ostia::python
