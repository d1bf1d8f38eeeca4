#include "ostia/core/private_folder.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace ostia::core {
namespace {

namespace fs = std::filesystem;

TEST(PrivateFolder, IsThisUsersAloneAndGoesWithItsContent) {
  fs::path path;
  {
    const PrivateFolder folder, other;
    path = folder.path();
    EXPECT_NE(path, other.path());
    ASSERT_TRUE(fs::is_directory(path));
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all);
    std::ofstream(path / "voxels") << "something";
    EXPECT_TRUE(fs::exists(path / "voxels"));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(PrivateFolder, TellsTheWayOutWhereNoneCanBeMade) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  for (const char* unfit : {"/proc", "/no-such-folder"}) {
    ::setenv("TMPDIR", unfit, 1);
    try {
      const PrivateFolder folder;
      ADD_FAILURE() << "a folder was made in " << unfit;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("TMPDIR"), std::string::npos) << error.what();
    }
  }
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
}

}  // namespace
}  // namespace ostia::core
