#pragma once
/// \file The progress of a job on the terminal.

#include "ostia/core/task_context.h"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace ostia::app {

/// Polls a task and draws its stage, percentage and time left on stderr until destroyed. `mode`: "auto" draws
/// a bar on a terminal and nothing elsewhere, "plain" writes a line for each stage, "none" nothing.
class ProgressBar {
 public:
  ProgressBar(core::TaskContext task, const std::string& mode);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void run(bool bar);
  core::TaskContext task_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace ostia::app
