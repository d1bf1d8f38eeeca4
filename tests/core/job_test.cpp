#include "ostia/core/job.h"

#include "ostia/core/background_task.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/core/parallel.h"
#include "ostia/core/private_folder.h"

#include <gtest/gtest.h>

#include <thread>

namespace ostia::core {
namespace {

using Texts = std::vector<std::string>;

class JobTest : public ::testing::Test {
 protected:
  JobTest() { set_log(LogFormat::text, LogLevel::off); }
  ~JobTest() override {
    set_log(LogFormat::text, LogLevel::info);
    set_max_threads(0);
  }
};

TEST_F(JobTest, HearsWhatIsSaidInItsOwnThreadEachOnce) {
  const Job one, other;
  {
    const JobHere here(&one);
    log_warning("a");
    log_warning("a");
    const JobHere inner(&other);
    log_warning("b");
  }
  log_warning("nobody's");
  EXPECT_EQ(one.warnings(), Texts{"a"});
  EXPECT_EQ(other.warnings(), Texts{"b"});
  EXPECT_EQ(current_job(), nullptr);
}

TEST_F(JobTest, LoopsBesideEachOtherAreHeardApart) {
  set_max_threads(4);
  constexpr int jobs = 4;
  std::vector<Job> all(jobs);
  std::vector<std::thread> threads;
  for (int j = 0; j < jobs; ++j)
    threads.emplace_back([&all, j] {
      const JobHere here(&all[static_cast<std::size_t>(j)]);
      for (int round = 0; round < 20; ++round)
        parallel_for(64, 1, [j](std::size_t) { log_warning("job " + std::to_string(j)); });
    });
  for (std::thread& thread : threads) thread.join();
  for (int j = 0; j < jobs; ++j)
    EXPECT_EQ(all[static_cast<std::size_t>(j)].warnings(), Texts{"job " + std::to_string(j)});
}

TEST_F(JobTest, WorkInTheBackgroundIsHeardToo) {
  const Job job;
  const JobHere here(&job);
  BackgroundTask<int> task([](const TaskContext&) {
    log_warning("beside");
    return 1;
  });
  EXPECT_EQ(task.get(), 1);
  EXPECT_EQ(job.warnings(), Texts{"beside"});
  EXPECT_EQ(heard_warnings(), Texts{"beside"});
}

TEST_F(JobTest, PublishesNothingOnceItIsCancelled) {
  const PrivateFolder folder;
  write_file(folder.path() / "old", "as it was");
  const Job job;
  const JobHere here(&job);
  job.task().cancel();
  EXPECT_THROW(write_file(folder.path() / "new", "content"), Cancelled);
  EXPECT_THROW(write_file(folder.path() / "old", "content"), Cancelled);
  StagedFolder staged(folder.path() / "made");
  EXPECT_THROW(staged.commit(), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "made"));
  const JobHere none(nullptr);
  EXPECT_EQ(read_file(folder.path() / "old"), "as it was");
}

}  // namespace
}  // namespace ostia::core
