#pragma once
/// \file The window while what it will show is prepared.

#include "gl_window.h"
#include "preparation.h"
#include "start_clock.h"

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"

#include <chrono>
#include <functional>
#include <memory>

struct GLFWwindow;

namespace ostia::live {

/// Draws what is being done (`work`'s stage and progress) until `ready`, which waits as long as it is told at
/// most. The first picture comes at once. False where the window was closed (Q and Escape close it, too) or
/// `task` cancelled before: then the window is hidden. Its title says so until the caller sets it. The
/// contexts of OpenGL and Dear ImGui are current.
bool show_waiting(GLFWwindow* window, const core::TaskContext& work,
                  const std::function<bool(std::chrono::milliseconds)>& ready, StartTimes& times,
                  const core::TaskContext& task);

template <class Result>
bool show_waiting(GLFWwindow* window, const Preparation<Result>& work, StartTimes& times,
                  const core::TaskContext& task) {
  return show_waiting(
      window, work.task(), [&](std::chrono::milliseconds wait) { return work.ready(wait); }, times, task);
}

/// Opened while the work goes on. Throws ResourceError as GlWindow does, or what the work throws where both
/// fail: a file that cannot be read is the first thing to be told.
template <class Result>
std::unique_ptr<const GlWindow> window_beside(Preparation<Result>& work, const Options& options) {
  try {
    return std::make_unique<const GlWindow>(options);
  } catch (const ResourceError&) {
    work.get();
    throw;
  }
}

}  // namespace ostia::live
