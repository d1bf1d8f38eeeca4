#pragma once
// Waiting that a cancel ends.

#include "ostia/core/task_context.h"

#include <chrono>
#include <thread>

namespace ostia::pacs {

/// Before the second attempt one second, before each next twice as long, 8 s at most. Throws Cancelled.
inline void pause_before(int attempt, const core::TaskContext& task) {
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::seconds(1 << (attempt < 5 ? attempt - 2 : 3));
  while (std::chrono::steady_clock::now() < end) {
    task.throw_if_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace ostia::pacs
