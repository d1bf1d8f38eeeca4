#include "ostia/core/files.h"

#include "shared_data.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <string>
#include <vector>

namespace ostia::core {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Files, RoundTripsBinaryContent) {
  const fs::path folder = testing::temporary_folder("files");
  const std::string content("a\0b\xff\n", 5);
  write_file(folder / "a.bin", content);
  EXPECT_EQ(read_file(folder / "a.bin"), content);
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"a.bin"});
}

TEST(Files, AbandonedFileLeavesTheOldOneAlone) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "a.txt", "old");
  {
    StagedFile staged(folder / "a.txt");
    std::ofstream(staged.temporary()) << "half of the new";
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"a.txt"});
}

TEST(Files, MakesTheFoldersAbove) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "a" / "b" / "c.txt", "x");
  EXPECT_EQ(read_file(folder / "a" / "b" / "c.txt"), "x");
  StagedFolder staged(folder / "d" / "e" / "out");
  write_file(staged.temporary() / "f" / "g", "1");
  staged.commit();
  EXPECT_EQ(read_file(folder / "d" / "e" / "out" / "f" / "g"), "1");
}

TEST(Files, FoldersAboveGoAgainWhereNothingIsWritten) {
  const fs::path folder = testing::temporary_folder("files");
  { const StagedFile file(folder / "a" / "b" / "c.txt"); }
  { const StagedFolder staged(folder / "d" / "out"); }
  EXPECT_TRUE(names_in(folder).empty());
  fs::create_directory(folder / "a");
  { const StagedFile file(folder / "a" / "b" / "c.txt"); }
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"a"}) << "what was there stays";
}

TEST(Files, RefusesWhatIsNoFolder) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "mine", "x");
  for (const fs::path& below : {folder / "mine" / "a.txt", folder / "mine" / "b" / "a.txt"}) {
    try {
      write_file(below, "y");
      ADD_FAILURE();
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find((folder / "mine").string() + " is a file and no folder"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(read_file(folder / "mine"), "x");
  EXPECT_THROW(read_file(folder / "nothing"), IoError);
  EXPECT_THROW(read_file(folder), IoError);
  EXPECT_THROW(write_file(folder, "x"), IoError);
}

TEST(Files, SaysThatThereIsNoRoomAndKeepsTheOldFile) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "a.txt", "old");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_file(folder / "a.txt", std::string(100000, 'x')), ResourceError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"a.txt"});
}

TEST(Files, ReadsNoMoreThanItMay) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "big", std::string(1000, 'x'));
  EXPECT_THROW(read_file(folder / "big", 999), ResourceError);
  EXPECT_EQ(read_file(folder / "big", 1000).size(), 1000u);
}

TEST(Files, KeepsPathsWithSpacesUtf8AndLength) {
  const fs::path folder = testing::temporary_folder("files");
  const fs::path path = folder / ("Gef\xc3\xa4\xc3\x9f " + std::string(230, 'n') + ".txt");
  write_file(path, "x");
  EXPECT_EQ(read_file(path), "x");
}

TEST(StagedFolder, AppearsWholeOrNotAtAll) {
  const fs::path folder = testing::temporary_folder("files");
  {
    StagedFolder abandoned(folder / "out");
    write_file(abandoned.temporary() / "a", "1");
  }
  EXPECT_TRUE(names_in(folder).empty());
  StagedFolder staged(folder / "out/");
  write_file(staged.temporary() / "a", "2");
  EXPECT_FALSE(fs::exists(folder / "out"));
  staged.commit();
  EXPECT_EQ(read_file(folder / "out" / "a"), "2");
}

TEST(StagedFolder, MessagesNameWhatTheUserAskedFor) {
  const fs::path folder = testing::temporary_folder("files");
  const StagedFolder staged(folder / "out");
  try {
    write_file(staged.temporary() / "mine", "1");
    write_file(staged.temporary() / "mine" / "a", "1");
    FAIL();
  } catch (const IoError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find((folder / "out" / "mine").string()), std::string::npos) << message;
    EXPECT_EQ(message.find(".part-"), std::string::npos) << message;
  }
}

TEST(StagedFolder, ReplacesAnOldOneWhole) {
  const fs::path folder = testing::temporary_folder("files");
  fs::create_directory(folder / "out");
  write_file(folder / "out" / "old", "1");
  StagedFolder staged(folder / "out");
  write_file(staged.temporary() / "new", "2");
  staged.commit();
  EXPECT_EQ(names_in(folder / "out"), std::vector<std::string>{"new"});
  EXPECT_EQ(names_in(folder), std::vector<std::string>{"out"});
}

TEST(StagedFolder, RefusesAFileInItsPlace) {
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "out", "a file");
  EXPECT_THROW(StagedFolder(folder / "out"), IoError);
  EXPECT_EQ(read_file(folder / "out"), "a file");
}

TEST(Sha256, MatchesPublishedDigests) {
  // FIPS 180-2, appendix B.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const fs::path folder = testing::temporary_folder("files");
  write_file(folder / "abc", "abc");
  EXPECT_EQ(sha256_file(folder / "abc"), sha256("abc"));
  EXPECT_THROW(sha256_file(folder / "none"), IoError);
}

}  // namespace
}  // namespace ostia::core
