// Files that are not what was written: refused with a message, or opened sound. Never a crash.

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <random>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

std::string refusal(const fs::path& path, ExitCode code = ExitCode::bad_input) {
  try {
    CaseFile::open(path);
  } catch (const Error& e) {
    EXPECT_EQ(e.exit_code(), code) << e.what();
    return e.what();
  }
  return "opened";
}

void sql(const fs::path& path, const std::string& text) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &handle), SQLITE_OK);
  char* error = nullptr;
  EXPECT_EQ(sqlite3_exec(handle, text.c_str(), nullptr, nullptr, &error), SQLITE_OK) << (error ? error : "");
  sqlite3_free(error);
  sqlite3_close(handle);
}

class CaseDamage : public ::testing::Test {
 protected:
  void SetUp() override {
    {
      CaseFile file = CaseFile::create(path, tube_model(), ImageReference{std::string(64, 'a'), "case-3f2a"});
      file.apply(ring(10.0, 1.8));
      file.apply(renamed("two"));
      file.undo();
      file.annotate(added(analysis::MeasureKind::distance));
      file.annotate(added(analysis::MeasureKind::stenosis));
      file.annotate(marked("calcified"));
      file.set_setting("window", "700/300");
      annotations = text_of(*file.annotations());
      for (const lumen::Edit& edit : file.edits()) edits.push_back(lumen::op_name(edit));
      digest = lumen::digest(*file.model());
    }
    bytes = bytes_of_file(path);
  }
  TempFolder folder;
  fs::path path = folder / "a.ostia";
  std::string bytes, digest, annotations;
  std::vector<std::string> edits;
};

TEST_F(CaseDamage, OtherFilesAreRefused) {
  EXPECT_THAT(refusal(folder / "none.ostia"), HasSubstr("check the name"));
  write_bytes(path, "");
  EXPECT_THAT(refusal(path), HasSubstr("empty"));
  write_bytes(path, "solid lumen\nendsolid\n");
  EXPECT_THAT(refusal(path), HasSubstr("not a case"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("not a file"));
  sql(folder / "other.db", "CREATE TABLE t(a)");
  EXPECT_THAT(refusal(folder / "other.db"), HasSubstr("another program"));
  sql(folder / "like.db", "PRAGMA application_id = 1330861129; PRAGMA user_version = 1; CREATE TABLE t(a)");
  EXPECT_THAT(refusal(folder / "like.db"), HasSubstr("tables are not those of a case"));
}

TEST_F(CaseDamage, NewerVersionsSayWhichProgramIsNeeded) {
  sql(path, "PRAGMA user_version = 99; UPDATE meta SET value = '3.1.4' WHERE key = 'needs'");
  const std::string said = refusal(path);
  EXPECT_THAT(said, HasSubstr("format 99"));
  EXPECT_THAT(said, HasSubstr("3.1.4"));
  sql(path, "PRAGMA user_version = 0");
  EXPECT_THAT(refusal(path), HasSubstr("damaged"));
}

TEST_F(CaseDamage, TruncatedFilesAreRefused) {
  for (const double part : {0.0001, 0.001, 0.1, 0.5, 0.9, 0.9999}) {
    write_bytes(path, bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
    const std::string said = refusal(path);
    EXPECT_NE(said, "opened") << part;
    EXPECT_TRUE(said.find("truncated") != std::string::npos || said.find("empty") != std::string::npos)
        << said;
  }
}

TEST_F(CaseDamage, RowsThatWereTamperedWithAreRefused) {
  for (const char* change : {"UPDATE sample SET s_mm = s_mm + 1e-9 WHERE id = 20",
                             "DELETE FROM sample WHERE id = 20",
                             "UPDATE sample SET vessel = 99 WHERE id = 20",
                             "UPDATE model SET next_sample_id = 5",
                             "UPDATE vessel SET name = 'x'",
                             "DELETE FROM model",
                             "DELETE FROM journal WHERE number = 2",
                             "UPDATE journal SET parameters = '{}' WHERE number = 2",
                             "UPDATE journal SET state = 0 WHERE number = 3",
                             "DELETE FROM content",
                             "UPDATE content SET zlib = x'00'",
                             "UPDATE image SET pseudonym = 'x'",
                             "UPDATE setting SET value = 'x'",
                             "UPDATE vessel SET kernel = 'x'",
                             "UPDATE segment SET points = x'00'",
                             "UPDATE measurement SET from_mm = from_mm + 1e-9 WHERE id = 1",
                             "DELETE FROM measurement WHERE id = 2",
                             "UPDATE measurement SET kind = 'x'",
                             "UPDATE measurement SET name = 'x'",
                             "UPDATE measurement SET points = x'00' WHERE id = 1",
                             "UPDATE measurement SET id = -5 WHERE id = 1",
                             "INSERT INTO measurement SELECT 9, kind, name, points, vessel, 0, 0, 0, 0 FROM "
                             "measurement WHERE id = 1",
                             "UPDATE measurement SET vessel = 3000000000 WHERE id = 1",
                             "UPDATE mark SET note = 'x'",
                             "UPDATE mark SET color = x'00'",
                             "UPDATE mark SET checked = 7",
                             "UPDATE mark SET visible = 1",
                             "DELETE FROM mark",
                             "UPDATE annotation SET next_measurement_id = 7",
                             "UPDATE annotation SET checksum = checksum + 1",
                             "DELETE FROM annotation",
                             "DROP TABLE mark",
                             "INSERT INTO pressure_input VALUES('systolic_mmhg', 140)",
                             "INSERT INTO what_if VALUES(0, 4, 1, 2, 'open', 0)",
                             "DROP TABLE what_if",
                             "INSERT INTO report_version VALUES(1, '2026-03-01', 'x', '', 'x')",
                             "INSERT INTO report_note VALUES('report.impression', '{}')",
                             "DROP TABLE report_note",
                             "UPDATE journal SET op = 'cpr.stroke' WHERE op = 'vessel.mark'",
                             "CREATE TRIGGER t AFTER INSERT ON journal BEGIN DELETE FROM sample; END"}) {
    write_bytes(path, bytes);
    sql(path, change);
    EXPECT_THAT(refusal(path), ::testing::Not("opened")) << change;
  }
}

TEST_F(CaseDamage, AnyDamagedByteIsSeenOrDoesNotMatter) {
  std::mt19937 random(7);
  int refused = 0, opened = 0;
  const std::size_t count = 250;
  for (std::size_t i = 0; i < count; ++i) {
    std::string damaged = bytes;
    // The first page and its neighbours byte by byte at first, then anywhere; sometimes a whole stretch.
    const std::size_t at = i < 60 ? i * 2 : random() % bytes.size();
    const std::size_t length = i % 5 == 0 ? 1 + random() % 600 : 1;
    for (std::size_t k = at; k < std::min(damaged.size(), at + length); ++k)
      damaged[k] = static_cast<char>(damaged[k] ^ static_cast<char>(1 + random() % 255));
    write_bytes(path, damaged);
    try {
      CaseFile file = CaseFile::open(path, i % 2 ? OpenMode::read_write : OpenMode::read_only);
      EXPECT_EQ(lumen::digest(*file.model()), digest) << "at " << at;
      std::vector<std::string> found;
      for (const lumen::Edit& edit : file.edits()) found.push_back(lumen::op_name(edit));
      EXPECT_EQ(found, edits) << "at " << at;
      EXPECT_EQ(text_of(*file.annotations()), annotations) << "at " << at;
      ++opened;
    } catch (const Error& e) {
      EXPECT_NE(e.exit_code(), ExitCode::internal) << "at " << at << ": " << e.what();
      ++refused;
    }
    for (const char* suffix : {"-wal", "-journal"}) fs::remove(path.string() + suffix);
  }
  EXPECT_GT(refused, 90);
  EXPECT_GT(opened, 0);
}

TEST_F(CaseDamage, ADamagedWalLosesOnlyItsEnd) {
  // What a crash leaves: the file as it was, and a WAL with commits that are not in it yet.
  CaseFile file = CaseFile::open(path);
  file.apply(renamed("three"));
  const std::size_t first_commit = fs::file_size(path.string() + "-wal");
  file.annotate(marked("looked at"));
  const std::string main = bytes_of_file(path), wal = bytes_of_file(path.string() + "-wal");
  ASSERT_GT(wal.size(), 1000U);
  const fs::path copy = folder / "copy.ostia";
  for (const std::size_t size :
       {wal.size(), wal.size() - 1, first_commit, first_commit - 1, std::size_t{40}, std::size_t{1}}) {
    for (const OpenMode mode : {OpenMode::read_only, OpenMode::read_write}) {
      write_bytes(copy, main);
      write_bytes(copy.string() + "-wal", wal.substr(0, size));
      const CaseFile opened = CaseFile::open(copy, mode);
      const bool renamed = opened.model()->tree.vessels[0].name == "three";
      const bool noted = opened.annotations()->marks[0].note == "looked at";
      EXPECT_EQ(noted, size == wal.size()) << size;  // the last commit
      EXPECT_EQ(renamed, size >= first_commit) << size;
    }
  }
}

}  // namespace
}  // namespace ostia::session
