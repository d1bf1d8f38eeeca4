#include "ostia/session/known_patients.h"

#include "case_tools.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace ostia::session {
namespace {

using namespace testing;
using imaging::ShownIdentity;

const ShownIdentity jane{"Doe, Jane", "4711", "2024-03-01", "CTA 0.6 \xC3\xA9", 0};

unsigned mode_of_file(const fs::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 0777U : 0U;
}

TEST(KnownPatients, KnowNobodyAtFirstAndWriteNothing) {
  const TempFolder folder;
  KnownPatients known(folder / "share");
  EXPECT_FALSE(known.find("a"));
  known.remember("a", {});  // an image that says of nobody
  known.forget_all();
  EXPECT_FALSE(fs::exists(folder / "share"));
}

TEST(KnownPatients, AreThereAgainForThisUserAlone) {
  const TempFolder folder;
  const mode_t before = ::umask(0);
  KnownPatients(folder / "share").remember("a", jane);
  ::umask(before);
  EXPECT_EQ(KnownPatients(folder / "share").find("a"), jane);
  EXPECT_FALSE(KnownPatients(folder / "share").find("b"));
  EXPECT_EQ(mode_of_file(folder / "share" / "patients.json"), 0600U);
  EXPECT_EQ(mode_of_file(folder / "share"), 0700U);
}

TEST(KnownPatients, AreForgotten) {
  const TempFolder folder;
  KnownPatients known(folder / "share");
  known.remember("a", jane);
  known.forget_all();
  EXPECT_FALSE(known.find("a"));
  for (const fs::directory_entry& one : fs::directory_iterator(folder / "share"))
    EXPECT_EQ(bytes_of_file(one.path()).find("Jane"), std::string::npos) << one.path();
}

TEST(KnownPatients, ADamagedFileBeginsAnew) {
  const TempFolder folder;
  fs::create_directory(folder / "share");
  for (const char* text : {"", "{", "[]", "{\"v\": 1, \"images\": {\"a\": 3}}", "{\"v\": 2}"}) {
    write_bytes(folder / "share" / "patients.json", text);
    KnownPatients known(folder / "share");
    EXPECT_FALSE(known.find("a")) << text;
    known.remember("a", jane);
    EXPECT_EQ(known.find("a"), jane) << text;
  }
}

TEST(KnownPatients, TextsThatAreNotUtf8AreKeptAsFarAsTheyAre) {
  const TempFolder folder;
  KnownPatients known(folder / "share");
  known.remember("a", {"Do\xFF"
                       "e",
                       "", "", "", 0});
  ASSERT_TRUE(known.find("a"));
  EXPECT_EQ(known.find("a")->patient_name,
            "Do\xEF\xBF\xBD"
            "e");
}

TEST(KnownPatients, ThoseSeenLongestAgoGo) {
  const TempFolder folder;
  fs::create_directory(folder / "share");
  std::string text = "{\"v\": 1, \"images\": {";
  for (std::size_t i = 0; i < KnownPatients::most; ++i)
    text += (i ? ", " : "") + ("\"" + std::to_string(i)) + "\": {\"name\": \"N\", \"id\": \"\", " +
            "\"study_date\": \"\", \"series\": \"\", \"seen\": " + std::to_string(i) + "}";
  write_bytes(folder / "share" / "patients.json", text + "}}");
  KnownPatients known(folder / "share");
  known.remember("new", jane);
  EXPECT_FALSE(known.find("0"));
  EXPECT_TRUE(known.find("1"));
  EXPECT_TRUE(known.find("new"));
}

}  // namespace
}  // namespace ostia::session
