#include "ostia/core/parallel.h"

#include "ostia/core/job.h"
#include "ostia/core/parallel_invoke.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace ostia::core {
namespace {

class Parallel : public ::testing::Test {
 protected:
  ~Parallel() override { set_max_threads(0); }
};

double harmonic_sum() {
  return parallel_reduce(
      100000, 777, 0.0,
      [](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t i = first; i < last; ++i)
          sum += std::sin(static_cast<double>(i)) / static_cast<double>(i + 1);
        return sum;
      },
      [](double a, double b) { return a + b; });
}

TEST_F(Parallel, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 5}) {
    set_max_threads(threads);
    std::vector<int> visits(10007, 0);
    parallel_for(visits.size(), 64, [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(std::set<int>(visits.begin(), visits.end()), std::set<int>{1}) << threads;
  }
}

TEST_F(Parallel, ChunksDoNotDependOnTheNumberOfThreads) {
  std::vector<std::set<std::pair<std::size_t, std::size_t>>> seen;
  for (const int threads : {1, 3}) {
    set_max_threads(threads);
    std::mutex mutex;
    std::set<std::pair<std::size_t, std::size_t>> chunks;
    parallel_chunks(1000, 300, [&](std::size_t first, std::size_t last) {
      const std::lock_guard lock(mutex);
      chunks.emplace(first, last);
    });
    seen.push_back(chunks);
  }
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0].size(), 4u);
}

TEST_F(Parallel, ReductionHasTheSameBitsForAnyNumberOfThreads) {
  set_max_threads(1);
  const double one = harmonic_sum();
  for (const int threads : {2, 3, 8, 0}) {
    set_max_threads(threads);
    EXPECT_EQ(harmonic_sum(), one) << threads;
  }
}

TEST_F(Parallel, NothingToDoCallsNothing) {
  parallel_for(0, 1, [](std::size_t) { FAIL(); });
  EXPECT_EQ(parallel_reduce(
                0, 8, 5, [](std::size_t, std::size_t) { return 1; }, [](int a, int b) { return a + b; }),
            5);
}

TEST_F(Parallel, PassesExceptionsOn) {
  set_max_threads(2);
  EXPECT_THROW(parallel_for(1000, 10,
                            [](std::size_t i) {
                              if (i == 500) throw std::runtime_error("500");
                            }),
               std::runtime_error);
}

TEST_F(Parallel, LimitIsReported) {
  set_max_threads(3);
  EXPECT_EQ(max_threads(), 3);
  set_max_threads(0);
  EXPECT_GE(max_threads(), 1);
}

TEST_F(Parallel, BothPiecesOfWorkAreDoneAndErrorsComeOut) {
  for (const int threads : {1, 2}) {
    set_max_threads(threads);
    int first = 0, second = 0;
    parallel_invoke([&] { first = 1; }, [&] { parallel_for(1, 1, [&](std::size_t) { ++second; }); });
    EXPECT_EQ(first, 1);
    EXPECT_EQ(second, 1);
    EXPECT_THROW(parallel_invoke([] {}, [] { throw std::runtime_error("second"); }), std::runtime_error);
  }
}

TEST_F(Parallel, AThreadOfLowPriorityLeavesTheOthersTheirs) {
  const auto niceness = [] { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); };
  const int own = niceness();
  int lowered = own, inherited = own;
  std::thread([&] {
    lower_thread_priority();
    lower_thread_priority();  // says the same
    lowered = niceness();
    std::thread([&] { inherited = niceness(); }).join();
  }).join();
  EXPECT_GT(lowered, own);
  EXPECT_EQ(inherited, lowered);
  EXPECT_EQ(niceness(), own);
}

TEST_F(Parallel, LoopsOfAThreadOfLowPriorityAreDoneByOthersOfLowPriority) {
  set_max_threads(3);
  const double sum = harmonic_sum();
  std::thread([&] {
    lower_thread_priority();
    const int low = getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
    const Job job;
    const JobHere here(&job);
    std::mutex mutex;
    std::set<int> priorities;
    std::set<const Job*> jobs;
    std::vector<int> visits(3 * 50, 0);
    std::latch all_there(3);  // three at a time, or it would wait for ever
    parallel_for(3, 1, [&](std::size_t i) {
      all_there.arrive_and_wait();
      parallel_for(50, 4, [&](std::size_t k) {
        ++visits[50 * i + k];
        const std::lock_guard lock(mutex);
        priorities.insert(getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())));
        jobs.insert(current_job());
      });
    });
    EXPECT_EQ(visits, std::vector<int>(3 * 50, 1));
    EXPECT_EQ(priorities, std::set<int>{low});
    EXPECT_EQ(jobs, std::set<const Job*>{&job});
    EXPECT_EQ(harmonic_sum(), sum) << "to the bit";
    int done = 0;
    EXPECT_THROW(parallel_for(1000, 1,
                              [&](std::size_t i) {
                                if (i == 3) throw std::runtime_error("the fourth");
                                const std::lock_guard lock(mutex);
                                ++done;
                              }),
                 std::runtime_error);
    EXPECT_LT(done, 1000);
    parallel_for(1000, 1, [&](std::size_t) {
      const std::lock_guard lock(mutex);
      ++done;
    });
    EXPECT_GE(done, 1000) << "after a failure they go on";
  }).join();
  EXPECT_EQ(harmonic_sum(), sum);
}

}  // namespace
}  // namespace ostia::core
