#include "ostia/core/parallel.h"

#include "background_loops.h"

#include "ostia/core/job.h"

#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

namespace ostia::core {
namespace {

std::atomic<int> thread_limit{0};
thread_local bool in_background = false;

}  // namespace

void set_max_threads(int threads) {
  thread_limit.store(std::max(threads, 0));
}

int max_threads() {
  const int limit = thread_limit.load();
  const int cores = std::max(1, tbb::this_task_arena::max_concurrency());
  return limit > 0 ? limit : cores;
}

void lower_thread_priority() {
  constexpr int niceness = 10;
  in_background = true;
  // Linux keeps it by thread. Where it is refused the work goes on as it is.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
}

void start_loop_threads() {
  // The demand of one loop makes them all.
  const int threads = max_threads();
  parallel_chunks(static_cast<std::size_t>(4 * threads), 1, [](std::size_t, std::size_t) {});
}

void parallel_chunks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  if (grain == 0) grain = 1;
  const std::size_t chunks = (count + grain - 1) / grain;
  const auto run_chunk = [&](std::size_t chunk) {
    body(chunk * grain, std::min(count, (chunk + 1) * grain));
  };
  const int threads = max_threads();
  if (threads == 1 || chunks == 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
    return;
  }
  if (in_background) return detail::run_in_background(chunks, threads, run_chunk);
  const auto loop = [&, job = current_job()] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, chunks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const JobHere here(job);
          for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) run_chunk(chunk);
        },
        tbb::simple_partitioner());
  };
  if (thread_limit.load() > 0) {
    tbb::task_arena(threads).execute(loop);
  } else {
    loop();
  }
}

}  // namespace ostia::core
