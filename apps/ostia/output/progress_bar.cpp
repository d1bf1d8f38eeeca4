#include "output/progress_bar.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace ostia::app {
namespace {

using Clock = std::chrono::steady_clock;

std::string line(const core::TaskContext& task, Clock::time_point start) {
  constexpr int cells = 30;
  const double progress = task.progress();
  const int filled = static_cast<int>(progress * cells);
  std::string text = "\r[" + std::string(static_cast<std::size_t>(filled), '#') +
                     std::string(static_cast<std::size_t>(cells - filled), '.') + "] " +
                     std::to_string(static_cast<int>(progress * 100.0)) + " %  " + task.stage();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (progress > 0.05 && seconds > 1.0) {
    text += ", " + std::to_string(static_cast<long>(std::ceil(seconds * (1.0 - progress) / progress))) +
            " s left";
  }
  return text + "\033[K";
}

}  // namespace

ProgressBar::ProgressBar(core::TaskContext task, const std::string& mode) : task_(std::move(task)) {
  const bool bar = mode == "auto" && ::isatty(STDERR_FILENO) != 0;
  if (bar || mode == "plain") thread_ = std::thread([this, bar] { run(bar); });
}

ProgressBar::~ProgressBar() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ProgressBar::run(bool bar) {
  const Clock::time_point start = Clock::now();
  std::string stage;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return done_; })) {
    if (bar) {
      std::fputs(line(task_, start).c_str(), stderr);
    } else if (task_.stage() != stage) {
      stage = task_.stage();
      std::fprintf(stderr, "%3d %% %s\n", static_cast<int>(task_.progress() * 100.0), stage.c_str());
    }
  }
  if (bar) std::fputs("\r\033[K", stderr);
}

}  // namespace ostia::app
