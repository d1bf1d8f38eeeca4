#include "ostia/session/open_mark.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

namespace ostia::session {
namespace {

namespace fs = std::filesystem;

struct OpenMarkTest : ::testing::Test {
  testing::TempFolder folder;
  fs::path state = folder / "state";
};

TEST_F(OpenMarkTest, OfTheLivingNothingIsTakenAndOfTheDeadEverythingOnce) {
  OpenMark other(state);
  EXPECT_TRUE(other.take_left().empty());  // no folder yet
  {
    OpenMark living(state);
    living.set("/cases/a.ostia");
    EXPECT_TRUE(other.take_left().empty());
    living.set("/cases/b with a space.ostia");
    EXPECT_TRUE(other.take_left().empty());
  }
  EXPECT_EQ(other.take_left(), std::vector<fs::path>{"/cases/b with a space.ostia"});
  EXPECT_TRUE(other.take_left().empty());
}

TEST_F(OpenMarkTest, WhatIsClearedIsGoneAndOnlyItsOwn) {
  OpenMark one(state), two(state);
  one.set("/a.ostia");
  two.set("/b.ostia");
  two.clear();
  two.clear();
  EXPECT_TRUE(OpenMark(state).take_left().empty());
  two.set("/c.ostia");
  one.clear();
  EXPECT_TRUE(OpenMark(state).take_left().empty());
}

TEST_F(OpenMarkTest, AKilledProgramLeavesItsMarkForThisUserAlone) {
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    OpenMark mark(state);
    mark.set("/killed.ostia");
    (void)!::write(told[1], "x", 1);
    ::pause();
    ::_exit(0);
  }
  char ready = 0;
  ASSERT_EQ(::read(told[0], &ready, 1), 1);
  EXPECT_TRUE(OpenMark(state).take_left().empty());
  for (const auto& entry : fs::directory_iterator(state / "open")) {
    struct stat about {};
    ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0077U, 0U) << entry.path();
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(OpenMark(state).take_left(), std::vector<fs::path>{"/killed.ostia"});
  ::close(told[0]);
  ::close(told[1]);
}

TEST_F(OpenMarkTest, AFolderThatCannotBeMadeIsNamed) {
  std::ofstream(state) << "a file where the folder should be";
  OpenMark mark(state);
  try {
    mark.set("/a.ostia");
    ADD_FAILURE() << "was written";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find(state.string()), std::string::npos) << error.what();
  }
  EXPECT_TRUE(mark.take_left().empty());
}

}  // namespace
}  // namespace ostia::session
