#pragma once
/// \file Long work called from Python: without the interpreter's lock, told of, and ended by Ctrl-C.

#include "ostia/core/task_context.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

namespace ostia::python {

namespace py = pybind11;

/// Runs `work` in a thread of its own while the calling one waits without the interpreter's lock. Every 50 ms
/// it looks for signals, a KeyboardInterrupt cancels the work, and tells `progress`: None, a callable that
/// takes (fraction, stage), or True for a bar. What either raises, or the work throws, is thrown here once
/// the work has ended. Warnings of the libraries go to Python's logging, under the name "ostia".
void run_watched(const py::object& progress, const std::function<void(const core::TaskContext&)>& work);

/// The same for work that has a result.
template <class Work>
auto watched(const py::object& progress, Work&& work) {
  using Result = decltype(work(std::declval<const core::TaskContext&>()));
  std::optional<Result> result;
  run_watched(progress, [&](const core::TaskContext& task) { result.emplace(work(task)); });
  return std::move(*result);
}

/// Work of milliseconds that nobody watches, without the interpreter's lock.
template <class Work>
auto unlocked(Work&& work) {
  const py::gil_scoped_release released;
  return work();
}

}  // namespace ostia::python
