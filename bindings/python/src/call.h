#pragma once
/// \file Long work called from Python: without the interpreter's lock, told of, and ended by Ctrl-C.

#include "array.h"

#include "ostia/core/task_context.h"

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace ostia::python {

namespace py = pybind11;

using Work = std::function<void(const core::TaskContext&)>;

/// Runs `work` in a thread of its own while the calling one waits without the interpreter's lock. Every 50 ms
/// it looks for signals, a KeyboardInterrupt cancels the work, and tells `progress`: None, a callable that
/// takes (fraction, stage), or True for a bar. What either raises, or the work throws, is thrown here once
/// the work has ended. Warnings of the work, and of it alone, go to Python's logging, under the name "ostia".
void run_watched(const py::object& progress, const Work& work);

/// The same for work that cannot be cancelled on its way, as reading a file by another library: after an
/// interrupt it is left to end by itself, which is waited for before the process ends; what it makes is
/// dropped, and files that it writes do not appear. It owns all that it uses (`kept`).
void run_left(const py::object& progress, Work work);

/// The same for work that has a result.
template <class Call>
auto watched(const py::object& progress, Call&& work) {
  using Result = decltype(work(std::declval<const core::TaskContext&>()));
  std::optional<Result> result;
  run_watched(progress, [&](const core::TaskContext& task) { result.emplace(work(task)); });
  return std::move(*result);
}
template <class Call>
auto watched_or_left(const py::object& progress, Call work) {
  using Result = decltype(work(std::declval<const core::TaskContext&>()));
  if constexpr (std::is_void_v<Result>) {
    run_left(progress, std::move(work));
  } else {
    const auto result = std::make_shared<std::optional<Result>>();
    run_left(progress, [result, work = std::move(work)](const core::TaskContext& task) {
      result->emplace(work(task));
    });
    return std::move(**result);
  }
}

/// Work of milliseconds that nobody watches, without the interpreter's lock. Its warnings go to Python's
/// logging.
void run_unlocked(const std::function<void()>& work);
template <class Call>
auto unlocked(Call&& work) {
  using Result = decltype(work());
  if constexpr (std::is_void_v<Result>) {
    run_unlocked([&] { work(); });
  } else {
    std::optional<Result> result;
    run_unlocked([&] { result.emplace(work()); });
    return std::move(*result);
  }
}

/// A value that a function was given, which stays as long as work that may outlast the call needs it. With
/// the interpreter's lock.
template <class T>
std::shared_ptr<const T> kept(const T& given) {
  const auto held = std::make_shared<Held>(py::cast(&given, py::return_value_policy::reference));
  return {&given, [held](const T*) {}};
}

/// When Python ends: calls in other threads are cancelled and waited for, since a thread that comes back to
/// an interpreter which has ended would take the process down. From then on the main thread's calls run as
/// they are, and other threads stay in theirs until the process is gone.
void end_all_calls();

}  // namespace ostia::python
