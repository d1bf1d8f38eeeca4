#include "ostia/core/path_digest.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gtest/gtest.h>

namespace ostia::core {
namespace {
namespace fs = std::filesystem;

// As the standard's examples give them (FIPS 180-4).
constexpr const char* of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* of_nothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST(PathDigest, OfAFileAndOfEach) {
  const fs::path folder = testing::temporary_folder("digest");
  write_file(folder / "abc", "abc");
  write_file(folder / "empty", "");
  EXPECT_EQ(sha256_of_path(folder / "abc"), of_abc);
  EXPECT_EQ(sha256_of_each({folder / "empty", folder / "abc"}),
            (std::vector<std::string>{of_nothing, of_abc}));
}

TEST(PathDigest, OfFilesIsThatOfAFolderWithJustThem) {
  const fs::path folder = testing::temporary_folder("digest"), other = testing::temporary_folder("digest");
  fs::create_directories(folder / "below");
  write_file(folder / "below" / "a", "abc");
  write_file(folder / "b", "");
  write_file(other / "a", "");
  const std::string expected = sha256(std::string(of_abc) + of_nothing);
  EXPECT_EQ(sha256_of_path(folder), expected);
  EXPECT_EQ(sha256_of_files({folder / "below" / "a", other / "a"}), expected);
  EXPECT_EQ(sha256_of_files({other / "a", folder / "below" / "a", other / "a"}), expected);
  EXPECT_EQ(sha256_of_digests({of_nothing, of_abc}), expected);
  EXPECT_NE(sha256_of_files({folder / "b", other / "a"}), expected);
}

TEST(PathDigest, TellsHowFarItIsAndCanBeCancelled) {
  const fs::path folder = testing::temporary_folder("digest");
  write_file(folder / "a", "abc");
  const TaskContext task;
  sha256_of_files({folder / "a"}, task.sub(0.0, 0.5));
  EXPECT_DOUBLE_EQ(task.progress(), 0.5);
  task.cancel();
  EXPECT_THROW(sha256_of_files({folder / "a"}, task), Cancelled);
}

TEST(PathDigest, RefusesWhatIsNoFile) {
  const fs::path folder = testing::temporary_folder("digest");
  EXPECT_THROW(sha256_of_files({}), InvalidInput);
  EXPECT_THROW(sha256_of_files({folder}), InvalidInput);
  EXPECT_THROW(sha256_of_files({folder / "none"}), IoError);
  EXPECT_THROW(sha256_of_path(folder), InvalidInput);
  EXPECT_THROW(sha256_of_path("/dev/null"), InvalidInput);
}

}  // namespace
}  // namespace ostia::core
