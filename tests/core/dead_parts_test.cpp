// What dead runs leave behind, and who may work in a folder.

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/folder_lock.h"
#include "ostia/core/kept_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace ostia::core {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> sorted_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A process that does something, says so, and lives on until it is killed.
class Other {
 public:
  explicit Other(const std::function<void()>& work) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    child_ = ::fork();
    if (child_ == 0) {
      work();
      if (::write(ends[1], "x", 1) != 1) ::_exit(1);
      while (true) ::pause();
    }
    ::close(ends[1]);
    char ready = 0;
    EXPECT_EQ(::read(ends[0], &ready, 1), 1);
    ::close(ends[0]);
  }
  ~Other() { kill(); }
  void kill() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    child_ = 0;
  }
  pid_t process() const { return child_; }

 private:
  pid_t child_ = 0;
};

TEST(DeadParts, OfTheDeadGoAndOfTheLivingStay) {
  const fs::path folder = testing::temporary_folder("parts");
  const auto work = [&] {
    new StagedFile(folder / "table.csv");  // never committed: its process ends before
    auto* made = new StagedFolder(folder / "case");
    write_file(made->temporary() / "half", "1");
    const auto* file = new StagedFile(folder / "b.txt");
    std::ofstream(file->temporary()) << "half";
  };
  Other dead(work);
  Other alive(work);
  dead.kill();
  fs::create_directory(folder / ".part-nobody");
  fs::create_directory(folder / ".part-12-x-case");
  write_file(folder / "part-1-0-a", "somebody else's");
  EXPECT_EQ(sorted_names(folder).size(), 7u);
  EXPECT_EQ(remove_dead_parts(folder), 2u);
  const std::vector<std::string> left = sorted_names(folder);
  EXPECT_EQ(left.size(), 5u);
  const std::string own = ".part-" + std::to_string(alive.process()) + "-";
  EXPECT_EQ(
      std::count_if(left.begin(), left.end(), [&](const std::string& name) { return name.starts_with(own); }),
      2);
  alive.kill();
  EXPECT_EQ(remove_dead_parts(folder), 2u);
  EXPECT_EQ(remove_dead_parts(folder / "nothing"), 0u);
}

TEST(DeadParts, TheNextRunForTheSameTargetTakesThemAway) {
  const fs::path folder = testing::temporary_folder("parts");
  const auto make = [&](const std::string& name) {
    auto* made = new StagedFolder(folder / name);
    write_file(made->temporary() / "half", "1");
  };
  Other(std::function<void()>([&] { make("out"); })).kill();
  Other(std::function<void()>([&] { make("other"); })).kill();
  Other alive([&] { make("out"); });
  StagedFolder staged(folder / "out");
  const std::vector<std::string> left = sorted_names(folder);
  EXPECT_EQ(left.size(), 3u);  // the other target's, the living one's, and its own
  EXPECT_TRUE(
      std::any_of(left.begin(), left.end(), [](const auto& name) { return name.ends_with("-other"); }));
}

TEST(DeadParts, AnEarlierProcessOfTheSameNumberIsInNobodysWay) {
  const fs::path folder = testing::temporary_folder("parts");
  const std::string own = ".part-" + std::to_string(::getpid()) + "-";
  for (int i = 0; i < 2000; ++i) fs::create_directory(folder / (own + std::to_string(i) + "-out"));
  const StagedFolder staged(folder / "out");  // a container begins its numbers anew
  write_file(staged.temporary() / "a", "1");
  EXPECT_EQ(sorted_names(folder), std::vector<std::string>{staged.temporary().filename().string()});
  EXPECT_EQ(remove_dead_parts(folder), 0u);
}

TEST(FolderLock, IsOnesAtATimeAndADeadOnesIsNobodys) {
  const fs::path folder = testing::temporary_folder("lock");
  Other holder([&] { new FolderLock(folder, "out", "wait"); });
  try {
    const FolderLock second(folder, "out", "wait for it, or end it");
    FAIL() << "two hold it";
  } catch (const ResourceError& error) {
    EXPECT_EQ(std::string(error.what()), "cannot work in out: another run (process " +
                                             std::to_string(holder.process()) +
                                             ") is at work there; wait for it, or end it");
  }
  EXPECT_EQ(sorted_names(folder), std::vector<std::string>{".ostia-lock"});
  holder.kill();
  { const FolderLock taken_over(folder, "out", ""); }
  EXPECT_TRUE(sorted_names(folder).empty());
  EXPECT_THROW(FolderLock(folder / "nothing", "out", ""), IoError);
}

TEST(FolderLock, WaitsWhereItShallAndCanBeCancelled) {
  const fs::path folder = testing::temporary_folder("lock");
  Other holder([&] { new FolderLock(folder, "out", ""); });
  const TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(FolderLock(folder, "out", "", WhenBusy::wait, cancelled), Cancelled);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    holder.kill();
  });
  { const FolderLock waited(folder, "out", "", WhenBusy::wait); }
  later.join();
  EXPECT_EQ(holder.process(), 0);
}

TEST(KeptFolder, WhatWasRecordedOutlivesItsRun) {
  const fs::path folder = testing::temporary_folder("kept");
  Other([&] {
    auto* kept = new KeptFolder(folder / "out");
    write_file(kept->result() / "whole", "1");
    kept->set_record("whole");
    fs::create_directory(kept->result() / "deep");
    auto* half = new StagedFile(kept->result() / "deep/half");
    std::ofstream(half->temporary()) << "half";
  }).kill();
  EXPECT_FALSE(fs::exists(folder / "out"));
  KeptFolder kept(folder / "out/");
  EXPECT_EQ(kept.record(), "whole");
  EXPECT_EQ(read_file(kept.result() / "whole"), "1");
  EXPECT_TRUE(sorted_names(kept.result() / "deep").empty());
  EXPECT_THROW(KeptFolder(folder / "out"), ResourceError);
  kept.commit();
  EXPECT_EQ(sorted_names(folder), std::vector<std::string>{"out"});
  EXPECT_EQ(sorted_names(folder / "out"), (std::vector<std::string>{"deep", "whole"}));
}

TEST(KeptFolder, LeavesNothingWhereNothingWasRecorded) {
  const fs::path folder = testing::temporary_folder("kept");
  {
    const KeptFolder kept(folder / "out");
    write_file(kept.result() / "half", "1");
  }
  EXPECT_TRUE(sorted_names(folder).empty());
  write_file(folder / "file", "1");
  EXPECT_THROW(KeptFolder(folder / "file"), IoError);
  EXPECT_THROW(KeptFolder(folder / "file/out"), IoError);
  { const KeptFolder kept(folder / "made/out"); }
  EXPECT_EQ(sorted_names(folder), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace ostia::core
