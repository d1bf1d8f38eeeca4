#include "ostia/imaging/archive.h"

#include "dicom_writer.h"
#include "shared_data.h"
#include "zip_writer.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/imaging/dicom.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using testing::CtSlice;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::zip_bytes;
using testing::ZipMember;

/// TMPDIR is a folder of the test, so that what is left behind can be seen.
class UnpackArchive : public ::testing::Test {
 protected:
  UnpackArchive() {
    if (const char* old = std::getenv("TMPDIR")) before_ = old;
    ::setenv("TMPDIR", temporary_.c_str(), 1);
  }
  ~UnpackArchive() override {
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
  }

  fs::path written(const std::string& bytes) const {
    const fs::path path = folder_ / "images.zip";
    testing::write_bytes(path, bytes);
    return path;
  }
  fs::path zip(const std::vector<ZipMember>& members) const { return written(zip_bytes(members)); }

  /// What it is refused with. Nothing may be left, and no name of a member be told.
  template <class E = InvalidInput>
  std::string refusal(const fs::path& path, const ArchiveLimits& limits = {}) const {
    std::string message = "unpacked, and not refused";
    try {
      unpack_archive(path, limits);
    } catch (const E& error) {
      message = error.what();
    }
    EXPECT_TRUE(fs::is_empty(temporary_)) << message;
    EXPECT_THAT(message, Not(HasSubstr("DOE"))) << message;
    return message;
  }

  fs::path folder_ = testing::temporary_folder("zips"), temporary_ = testing::temporary_folder("tmpdir");

 private:
  std::string before_;
};

TEST_F(UnpackArchive, FilesComeOutWholeAndVanish) {
  const std::string large(3'000'000, 'x');
  const fs::path path =
      zip({{"DOE^JANE/", ""}, {"DOE^JANE/IM1", "one"}, {"DOE^JANE/IM2", large, true}, {"e", ""}});
  EXPECT_TRUE(is_zip_archive(path));
  {
    core::TaskContext task;
    const UnpackedArchive archive = unpack_archive(path, {}, task);
    EXPECT_EQ(task.progress(), 1.0);
    EXPECT_EQ(archive.files(), 3U);
    EXPECT_EQ(archive.bytes(), 3'000'003U);
    EXPECT_EQ(archive.folder().parent_path(), temporary_);
    EXPECT_EQ(core::read_file(archive.folder() / "000001"), "one");
    EXPECT_EQ(core::read_file(archive.folder() / "000002"), large);
    EXPECT_EQ(fs::status(archive.folder()).permissions(), fs::perms::owner_all);
    for (const auto& entry : fs::recursive_directory_iterator(temporary_))
      EXPECT_THAT(entry.path().string(), Not(HasSubstr("DOE")));
  }
  EXPECT_TRUE(fs::is_empty(temporary_));
}

TEST_F(UnpackArchive, NamesThatLeadOutAreRefused) {
  const fs::path outside = folder_ / "outside";
  EXPECT_THAT(refusal(zip({{"good", "1"}, {"../outside", "DOE^JANE"}})),
              AllOf(HasSubstr("member 2"), HasSubstr("leads out of the archive")));
  EXPECT_THAT(refusal(zip({{"a/../../outside", "x"}})), HasSubstr("leads out"));
  EXPECT_THAT(refusal(zip({{"a/..", "x"}})), HasSubstr("leads out"));
  EXPECT_THAT(refusal(zip({{outside.string(), "x"}})), HasSubstr("absolute name"));
  EXPECT_THAT(refusal(zip({{"C:/outside", "x"}})), HasSubstr("drive"));
  EXPECT_THAT(refusal(zip({{"..\\outside", "x"}})), HasSubstr("backslash"));
  EXPECT_FALSE(fs::exists(outside));
  // Two dots within a name are a name.
  EXPECT_EQ(unpack_archive(zip({{"a..b/..c", "x"}})).files(), 1U);
}

TEST_F(UnpackArchive, OddNamesAreRefused) {
  EXPECT_THAT(refusal(zip({{"DOE\nJANE", "x"}})), HasSubstr("control character"));
  EXPECT_THAT(refusal(zip({{std::string("\x1b[2Jx"), "x"}})), HasSubstr("control character"));
  EXPECT_THAT(refusal(zip({{"", "x"}})), HasSubstr("has no name"));
  EXPECT_THAT(refusal(zip({{std::string(5000, 'a'), "x"}})), HasSubstr("a name of 5000 bytes"));
  EXPECT_EQ(unpack_archive(zip({{"M\xc3\xbcller/Bild 1 ^&'.dcm", "x", false, 0, 0x800}})).files(), 1U);
  EXPECT_EQ(unpack_archive(zip({{"M\x81ller/Bild", "x"}})).files(), 1U);  // code page 437
}

TEST_F(UnpackArchive, LinksAndDevicesAreRefused) {
  for (const std::uint32_t mode : {0120777U, 0020666U, 0060666U, 0010666U, 0140777U}) {
    EXPECT_THAT(refusal(zip({{"DOE", "/etc/passwd", false, mode}})), HasSubstr("is a link or a device"))
        << mode;
  }
  EXPECT_EQ(unpack_archive(zip({{"a", "x", false, 0100644}, {"d/", "", false, 0040755}})).files(), 1U);
}

TEST_F(UnpackArchive, EncryptedMembersAreToldAsSuch) {
  EXPECT_THAT(refusal(zip({{"DOE", "secret secret secret", false, 0, 1}})),
              AllOf(HasSubstr("is encrypted"), HasSubstr("password")));
}

TEST_F(UnpackArchive, BombsStopAtWhatTheyDeclare) {
  // What they declare is looked at before anything is unpacked.
  const ZipMember bomb{"DOE", std::string(1 << 20, '\0'), true, 0, 0, 200 << 20};
  EXPECT_THAT(refusal(zip({bomb})), HasSubstr("more than any image does"));
  // One that declares less than it holds.
  const ZipMember liar{"DOE", std::string(4 << 20, '\0'), true, 0, 0, 1000};
  EXPECT_THAT(refusal(zip({liar})), HasSubstr("member 1 is damaged"));
  // Many that are harmless each.
  const std::vector<ZipMember> many(10, {"a", std::string(1 << 18, '\0'), true, 0, 0, 50 << 20});
  EXPECT_THAT(refusal(zip(many)), HasSubstr("more than images do"));
  ArchiveLimits limits;
  limits.ratio = 1e6;
  limits.total_bytes = 100 << 20;
  EXPECT_THAT(refusal(zip(many), limits), HasSubstr("unpacks to more than 100 MiB"));
  limits.member_bytes = 1 << 20;
  EXPECT_THAT(refusal(zip(many), limits), HasSubstr("at most 1 MiB are allowed"));
  limits = {};
  limits.members = 9;
  EXPECT_THAT(refusal(zip(many), limits), HasSubstr("10 members; at most 9"));
  limits.members = 0;
  EXPECT_THAT(refusal(zip({}), limits), HasSubstr("at least 1"));
}

TEST_F(UnpackArchive, DamagedOnesAreRefused) {
  const std::string good = zip_bytes({{"DOE", std::string(5000, 'x') + "end", true}, {"JANE", "two"}});
  EXPECT_THAT(refusal(written("")), HasSubstr("damaged or cut short"));
  EXPECT_THAT(refusal(written(good.substr(0, good.size() / 2))), HasSubstr("damaged or cut short"));
  EXPECT_THAT(refusal(zip({{"DOE", "content", false, 0, 0, -1, 12345}})), HasSubstr("member 1 is damaged"));
  EXPECT_THAT(refusal(zip({{"DOE", "x", false, 0, 0, 2'000'000}})), HasSubstr("damaged"));
  EXPECT_THAT(refusal(zip({{"DOE", "x", false, 0, 0, -1, -1, 97}})), HasSubstr("packed by method 97"));
  for (std::size_t at = 0; at < good.size(); at += 3) {  // nothing crashes, and nothing is left
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x5A);
    refusal(written(bytes));
  }
  EXPECT_THAT(refusal<IoError>(folder_ / "none.zip"), HasSubstr("is not there"));
}

TEST_F(UnpackArchive, NestedZipIsAFile) {
  const std::string inner = zip_bytes({{"../out", "x"}});
  const UnpackedArchive archive = unpack_archive(zip({{"inner.zip", inner}}));
  EXPECT_EQ(archive.files(), 1U);
  EXPECT_EQ(core::read_file(archive.folder() / "000001"), inner);
}

TEST_F(UnpackArchive, FullDiskIsToldAndLeavesNothing) {
  // A limit on the size of files stands in for the disk.
  const fs::path path = zip({{"DOE", std::string(4 << 20, 'x')}});
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = before;
  small.rlim_cur = 1 << 20;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal<ResourceError>(path);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, AllOf(HasSubstr("cannot write in the temporary folder"), HasSubstr("TMPDIR")));
}

TEST_F(UnpackArchive, CancelledLeavesNothing) {
  const fs::path path = zip({{"a", "x"}});
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(unpack_archive(path, {}, task), Cancelled);
  EXPECT_TRUE(fs::is_empty(temporary_));
}

std::vector<ZipMember> zipped_series(int count) {
  std::vector<ZipMember> members{{"DOE^JANE/README.txt", "nothing"},
                                 {"DOE^JANE/more.zip", zip_bytes({{"x", "y"}})}};
  for (int k = 0; k < count; ++k) {
    CtSlice slice;
    slice.sop_instance = "1.2.3.4." + std::to_string(k);
    slice.instance = std::to_string(k + 1);
    slice.position = "-10\\-20\\" + std::to_string(100.0 + 0.5 * k);
    slice.value = [k](int i, int j) { return 1024 + 100 * k + 10 * j + i; };
    members.push_back({"DOE^JANE/IM" + std::to_string(k), slice.file(), true});
  }
  return members;
}

TEST_F(UnpackArchive, ScannedSeriesKeepTheirFilesWhileTheyLive) {
  DicomSeries series;
  {
    const DicomFolder folder = scan_dicom(zip(zipped_series(5)));
    ASSERT_EQ(folder.series.size(), 1U);
    EXPECT_EQ(folder.skipped, 2U);
    series = folder.series.front();
  }
  ASSERT_EQ(series.files.size(), 5U);
  for (const fs::path& file : series.files) {
    EXPECT_TRUE(fs::exists(file));
    EXPECT_THAT(file.string(), Not(HasSubstr("DOE")));
  }
  series = {};
  EXPECT_TRUE(fs::is_empty(temporary_));
}

TEST_F(UnpackArchive, DamagedSlicesInsideAreToldWithoutTheirNames) {
  auto members = zipped_series(5);
  members.back().content.resize(members.back().content.size() - 8);
  try {
    read_dicom(zip(members));
    FAIL() << "a slice cut short was read";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("DOE")));
  }
  EXPECT_TRUE(fs::is_empty(temporary_));
}

#ifdef OSTIA_DECODES
TEST_F(UnpackArchive, ZippedSeriesIsReadAsAFolderIs) {
  const auto image = read_dicom(zip(zipped_series(5)));
  EXPECT_EQ(image.volume.geometry.size, (std::array<std::int64_t, 3>{5, 4, 5}));
  EXPECT_EQ(image.volume(3, 2, 4), 423);
  EXPECT_TRUE(fs::is_empty(temporary_));
}
#endif

}  // namespace
}  // namespace ostia::imaging
