#include "ostia/session/machine_state.h"

#include "case_file/machine_file.h"
#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/image_digest.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <csignal>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> names(const MachineState& machine) {
  std::vector<std::string> all;
  for (const RecentCase& one : machine.recent_cases()) all.push_back(one.path.filename().string());
  return all;
}

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 0777U : 0U;
}

TEST(MachineState, KnowsNothingAtFirstAndWritesNothing) {
  const TempFolder folder;
  MachineState machine(folder / "share");
  EXPECT_FALSE(machine.find_image("a"));
  EXPECT_FALSE(machine.setting("window"));
  EXPECT_THAT(machine.recent_cases(), IsEmpty());
  EXPECT_THAT(machine.take_notices(), IsEmpty());
  EXPECT_FALSE(fs::exists(folder / "share"));
}

TEST(MachineState, IsThereAgainTheNextTime) {
  const TempFolder folder;
  write_bytes(folder / "heart.nrrd", "image");
  {
    MachineState machine(folder / "a" / "share");
    machine.remember_image("abc", folder / "heart.nrrd");
    machine.remember_case({folder / "x.ostia", "case-3f2a", 1234567890123});
    machine.set_settings({{"layout", "b\"\xC3\xA9\n"}, {"theme", "dark"}});
    machine.set_setting("theme", "light");
  }
  const MachineState machine(folder / "a" / "share");
  ASSERT_TRUE(machine.find_image("abc"));
  EXPECT_EQ(machine.find_image("abc")->path, folder / "heart.nrrd");
  EXPECT_EQ(machine.find_image("abc")->series_uid, "");
  ASSERT_EQ(machine.recent_cases().size(), 1U);
  EXPECT_EQ(machine.recent_cases()[0].path, folder / "x.ostia");
  EXPECT_EQ(machine.recent_cases()[0].pseudonym, "case-3f2a");
  EXPECT_EQ(machine.recent_cases()[0].opened, 1234567890123);
  EXPECT_EQ(machine.setting("layout"), "b\"\xC3\xA9\n");
  EXPECT_EQ(machine.settings().size(), 2U);
  EXPECT_EQ(machine.setting("theme"), "light");
}

TEST(MachineState, IsForThisUserAlone) {
  const TempFolder folder;
  const mode_t before = ::umask(0);
  MachineState machine(folder / "share");
  machine.set_setting("a", "1");
  machine.set_setting("a", "2");
  ::umask(before);
  EXPECT_EQ(mode_of(folder / "share" / "machine.json"), 0600U);
  EXPECT_EQ(mode_of(folder / "share" / "machine.lock"), 0600U);
  EXPECT_EQ(mode_of(folder / "share"), 0700U);
}

TEST(MachineState, TwelveRecentCasesNewestFirst) {
  const TempFolder folder;
  MachineState machine(folder.path());
  for (int i = 0; i < 15; ++i) machine.remember_case({folder / ("c" + std::to_string(i)), "", i});
  EXPECT_EQ(names(machine).size(), MachineState::most_recent_cases);
  EXPECT_EQ(names(machine).front(), "c14");
  EXPECT_EQ(names(machine).back(), "c3");
  machine.remember_case({folder / "sub" / ".." / "c5", "", 99});  // the same place: moved to the front
  EXPECT_EQ(names(machine).front(), "c5");
  EXPECT_EQ(names(machine).size(), MachineState::most_recent_cases);
  machine.forget_case(folder / "c14");
  EXPECT_EQ(names(machine).at(1), "c13");
}

TEST(MachineState, APathNeedNotBeText) {
  const TempFolder folder;
  const std::string name = "J\xE9r\xF4me 100% \"x\"\n.ostia";  // Latin-1
  write_bytes(folder / name, "");
  MachineState machine(folder.path());
  machine.remember_case({folder / name, "", 1});
  machine.remember_image("abc", folder / name);
  EXPECT_EQ(machine.recent_cases().at(0).path, folder / name);
  EXPECT_EQ(machine.find_image("abc")->path, folder / name);
}

TEST(MachineState, AMovedImageIsNotFoundUntilItIsSeenElsewhere) {
  const TempFolder folder;
  MachineState machine(folder / "share");
  write_bytes(folder / "heart.nrrd", "the image");
  const ImageReference image = image_reference(folder / "heart.nrrd");
  machine.remember_image(image.sha256, folder / "heart.nrrd");
  fs::create_directory(folder / "archive");
  fs::rename(folder / "heart.nrrd", folder / "archive" / "h.nrrd");
  EXPECT_FALSE(machine.find_image(image.sha256));
  machine.remember_image(image.sha256, folder / "archive" / "h.nrrd");
  EXPECT_EQ(machine.find_image(image.sha256)->path, folder / "archive" / "h.nrrd");
}

TEST(MachineState, KnowsWhichSeriesOfAFolderAnImageWas) {
  const TempFolder folder;
  fs::create_directory(folder / "study");
  {
    MachineState machine(folder / "share");
    machine.remember_image("a", folder / "study", "1.2.840.3#2");
    machine.remember_image("b", folder / "study", "1.2\xFF.4");  // what a file says need not be text
  }
  MachineState machine(folder / "share");
  ASSERT_TRUE(machine.find_image("a") && machine.find_image("b"));
  EXPECT_EQ(machine.find_image("a")->path, folder / "study");
  EXPECT_EQ(machine.find_image("a")->series_uid, "1.2.840.3#2");
  EXPECT_EQ(machine.find_image("b")->series_uid, "1.2\xFF.4");
  machine.remember_image("a", folder / "study");
  EXPECT_EQ(machine.find_image("a")->series_uid, "");
}

TEST(MachineState, AFileWithoutSeriesIsRead) {
  const TempFolder folder;
  write_bytes(folder / "machine.json",
              R"({"v":1,"images":{"a":{"path":"/","seen":1}},"recent":[],"settings":{}})");
  MachineState machine(folder.path());
  ASSERT_TRUE(machine.find_image("a"));
  EXPECT_EQ(machine.find_image("a")->path, "/");
  EXPECT_EQ(machine.find_image("a")->series_uid, "");
  EXPECT_THAT(machine.take_notices(), IsEmpty());
}

TEST(MachineState, DamageIsMovedAsideWithANotice) {
  const std::string sound = machine_json({{{"abc", {"/x", 1, "1.2"}}}, {{"/c", "p", 2}}, {{"k", "v"}}});
  EXPECT_NO_THROW(machine_content(sound));
  const std::vector<std::string> damaged{
      "",
      "{",
      "[]",
      "null",
      sound.substr(0, sound.size() / 2),
      R"({"v":2,"images":{},"recent":[],"settings":{}})",
      R"({"v":1,"images":{},"recent":{},"settings":[]})",
      R"({"v":1,"images":{"a":{"path":"%4","seen":1}},"recent":[],"settings":{}})",
      R"({"v":1,"images":{"a":{"path":"/","seen":1,"series":7}},"recent":[],"settings":{}})",
      R"({"v":1,"images":{},"recent":[{"path":7}],"settings":{}})"};
  for (const std::string& content : damaged) {
    SCOPED_TRACE(content);
    const TempFolder folder;
    write_bytes(folder / "machine.json", content);
    write_bytes(folder / "machine.json.damaged-1", "from before");
    MachineState machine(folder.path());
    EXPECT_THAT(machine.recent_cases(), IsEmpty());
    const auto notices = machine.take_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_THAT(notices[0], HasSubstr("machine.json.damaged-2"));
    EXPECT_EQ(bytes_of_file(folder / "machine.json.damaged-2"), content);
    EXPECT_EQ(bytes_of_file(folder / "machine.json.damaged-1"), "from before");
    machine.set_setting("a", "b");
    EXPECT_EQ(MachineState(folder.path()).setting("a"), "b");
    EXPECT_THAT(machine.take_notices(), IsEmpty());
  }
}

TEST(MachineState, WhatCannotBeKeptChangesNothing) {
  const TempFolder folder;
  MachineState machine(folder.path());
  machine.set_setting("a", "1");
  const std::string before = bytes_of_file(folder / "machine.json");
  EXPECT_THROW(machine.set_setting("a", "\xff"), InvalidInput);
  EXPECT_EQ(bytes_of_file(folder / "machine.json"), before);
  EXPECT_THROW(MachineState("/proc/nowhere/share").set_setting("a", "b"), IoError);
  EXPECT_FALSE(MachineState("/proc/nowhere/share").setting("a"));
}

/// Runs in another process; its result is the exit status.
template <class Body>
pid_t elsewhere(const Body& body) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  int result = 99;
  try {
    result = body();
  } catch (const std::exception&) {
  }
  ::_exit(result);
}

int status_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 98;
}

TEST(MachineState, AFullDiskKeepsTheOldFile) {
  const TempFolder folder;
  MachineState(folder.path()).set_setting("a", "1");
  const std::string before = bytes_of_file(folder / "machine.json");
  const pid_t child = elsewhere([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100, 100};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      MachineState(folder.path()).set_setting("b", std::string(1000, 'x'));
    } catch (const ResourceError&) {
      return 0;
    }
    return 1;
  });
  EXPECT_EQ(status_of(child), 0);
  EXPECT_EQ(bytes_of_file(folder / "machine.json"), before);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_THAT(entry.path().filename().string(), ::testing::AnyOf("machine.json", "machine.lock"));
}

TEST(MachineState, ProcessesAtOnceLoseNothing) {
  const TempFolder folder;
  std::vector<pid_t> children;
  for (int k = 0; k < 4; ++k)
    children.push_back(elsewhere([&] {
      MachineState machine(folder / "share");
      int refused = 0;  // on a busy disk one may wait longer than it is allowed to, and is told so
      for (int i = 0; i < 25;) try {
          machine.set_setting(std::to_string(k) + "." + std::to_string(i), std::to_string(i * k));
          ++i;
        } catch (const IoError&) {
          if (++refused > 20) throw;
        }
      return 0;
    }));
  for (const pid_t child : children) EXPECT_EQ(status_of(child), 0);
  const auto settings = MachineState(folder / "share").settings();
  EXPECT_EQ(settings.size(), 100U);
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 25; ++i)
      EXPECT_EQ(settings.at(std::to_string(k) + "." + std::to_string(i)), std::to_string(i * k));
}

TEST(MachineState, AKillLeavesTheOldFileOrTheNewOne) {
  const TempFolder folder;
  for (int k = 0; k < 20; ++k) {
    const pid_t child = elsewhere([&] {
      MachineState machine(folder.path());
      for (int i = 0; i < 1000; ++i)
        machine.set_setting("n", std::string(2000, static_cast<char>('a' + i % 26)));
      return 0;
    });
    ::usleep(static_cast<useconds_t>(2000 + 700 * k));
    ::kill(child, SIGKILL);
    status_of(child);
    MachineState machine(folder.path());
    const auto value = machine.setting("n");
    if (value) {
      EXPECT_EQ(*value, std::string(2000, value->front()));
    }
    EXPECT_THAT(machine.take_notices(), IsEmpty());
    machine.set_setting("m", "still writable");  // the lock went with the process
  }
}

TEST(MachineState, AChangeDoesNotWaitForEver) {
  const TempFolder folder;
  MachineState machine(folder.path());
  machine.set_setting("a", "1");
  const int lock = ::open((folder / "machine.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  EXPECT_EQ(machine.setting("a"), "1");  // reading needs no lock
  EXPECT_THROW(machine.set_setting("a", "2"), IoError);
  ::close(lock);
  EXPECT_NO_THROW(machine.set_setting("a", "2"));
}

TEST(MachineState, ImagesSeenLongAgoGo) {
  MachineContent content;
  const TempFolder folder;
  for (std::size_t i = 0; i < MachineState::most_images; ++i)
    content.images["image" + std::to_string(i)] = {folder.path(), static_cast<std::int64_t>(i + 1)};
  write_bytes(folder / "machine.json", machine_json(content));
  MachineState machine(folder.path());
  ASSERT_TRUE(machine.find_image("image0"));
  machine.remember_image("new", folder.path());
  EXPECT_FALSE(machine.find_image("image0"));
  EXPECT_TRUE(machine.find_image("image1"));
  EXPECT_TRUE(machine.find_image("new"));
}

}  // namespace
}  // namespace ostia::session
