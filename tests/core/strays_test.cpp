#include "ostia/core/strays.h"

#include "shared_data.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace ostia::core {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The number of a process that has ended.
std::string dead_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return std::to_string(child);
}

TEST(Strays, OfDeadRunsAreFoundAtAnyDepthAndRemoved) {
  const fs::path folder = testing::temporary_folder("strays");
  const std::string dead = dead_process();
  const fs::path file = folder / ("a/b/.part-" + dead + "-0-lumen.vtp"),
                 made = folder / (".part-" + dead + "-1-model");
  fs::create_directories(file.parent_path());
  write_file(file, "half");
  fs::create_directories(made / "pictures");
  write_file(made / ("pictures/.part-" + dead + "-2-tree.png"), "half");
  write_file(folder / "a/lumen.vtp", "whole");
  write_file(folder / ".part-of-a-person", "a name of somebody's own");
  const StagedFolder in_work(folder / "other");
  EXPECT_THAT(strays_below(folder), ElementsAre(made, file));
  EXPECT_EQ(remove_strays(strays_below(folder)), 2U);
  EXPECT_THAT(strays_below(folder), IsEmpty());
  EXPECT_TRUE(fs::exists(folder / "a/lumen.vtp"));
  EXPECT_TRUE(fs::exists(folder / ".part-of-a-person"));
  EXPECT_TRUE(fs::exists(in_work.temporary()));
}

TEST(Strays, BehindALinkAreAnotherFolders) {
  const fs::path folder = testing::temporary_folder("strays-linked"),
                 other = testing::temporary_folder("strays-other");
  write_file(other / (".part-" + dead_process() + "-0-lumen.vtp"), "half");
  fs::create_directory_symlink(other, folder / "way");
  EXPECT_THAT(strays_below(folder), IsEmpty());
  EXPECT_THAT(strays_below(folder / "missing"), IsEmpty());
}

}  // namespace
}  // namespace ostia::core
