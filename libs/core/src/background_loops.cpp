#include "background_loops.h"

#include "ostia/core/job.h"
#include "ostia/core/parallel.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <thread>

namespace ostia::core::detail {
namespace {

struct OpenLoop {
  std::size_t count = 0;
  const std::function<void(std::size_t)>* run = nullptr;
  const Job* job = nullptr;
  int most_helpers = 0;
  std::atomic<std::size_t> next{0};
  int helpers = 0;             // with the lock
  std::exception_ptr failure;  // likewise, the first

  bool wants_help() const { return helpers < most_helpers && next.load() < count; }
};

/// Never ends: its threads wait for loops until the process does.
class Helpers {
 public:
  void run(OpenLoop& loop) {
    {
      const std::lock_guard lock(mutex_);
      for (; threads_ < loop.most_helpers; ++threads_) std::thread([this] { help(); }).detach();
      open_.push_back(&loop);
    }
    wake_.notify_all();
    work(loop);
    std::unique_lock lock(mutex_);
    open_.remove(&loop);
    left_.wait(lock, [&] { return loop.helpers == 0; });
    if (loop.failure) std::rethrow_exception(loop.failure);
  }

 private:
  void work(OpenLoop& loop) {
    for (std::size_t i = loop.next++; i < loop.count; i = loop.next++) try {
        (*loop.run)(i);
      } catch (...) {
        loop.next.store(loop.count);
        const std::lock_guard lock(mutex_);
        if (!loop.failure) loop.failure = std::current_exception();
      }
  }

  /// With the lock; null where none wants help. The last one first: it is within the others.
  OpenLoop* next_loop() {
    for (auto one = open_.rbegin(); one != open_.rend(); ++one)
      if ((*one)->wants_help()) return *one;
    return nullptr;
  }

  void help() {
    lower_thread_priority();
    std::unique_lock lock(mutex_);
    while (true) {
      OpenLoop* loop = nullptr;
      wake_.wait(lock, [&] { return (loop = next_loop()) != nullptr; });
      ++loop->helpers;
      lock.unlock();
      {
        const JobHere here(loop->job);
        work(*loop);
      }
      lock.lock();
      --loop->helpers;
      left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, left_;
  std::list<OpenLoop*> open_;
  int threads_ = 0;
};

}  // namespace

void run_in_background(std::size_t count, int threads, const std::function<void(std::size_t)>& run) {
  static Helpers* const helpers = new Helpers;
  OpenLoop loop;
  loop.count = count;
  loop.run = &run;
  loop.job = current_job();
  loop.most_helpers = threads - 1;
  helpers->run(loop);
}

}  // namespace ostia::core::detail
