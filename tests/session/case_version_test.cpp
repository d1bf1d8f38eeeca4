// Cases of older versions of the format, opened by this one.

#include "case_file/case_schema.h"
#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void case_version_sql(const fs::path& path, const std::string& text) {
  Database(path.string(), SQLITE_OPEN_READWRITE, path.string()).execute(text);
}

std::string version_of(const fs::path& path) {
  return Database(path.string(), SQLITE_OPEN_READONLY, path.string()).text_of("PRAGMA user_version");
}

/// A case as version 1 has it: without the tables of annotations.
class CaseVersion : public ::testing::Test {
 protected:
  void SetUp() override {
    {
      CaseFile file = CaseFile::create(path, tube_model());
      file.apply(ring(10.0, 1.8));
      file.apply(renamed("two"));
      file.undo();
      digest = lumen::digest(*file.model());
    }
    case_version_sql(
        path,
        "DROP TABLE annotation; DROP TABLE measurement; DROP TABLE mark; DROP TABLE "
        "evaluability; DROP TABLE lesion; DROP TABLE step_stamp; DROP TABLE image_axes; DROP "
        "TABLE pressure_input; DROP TABLE what_if; DROP TABLE report_note; DROP TABLE report_version; PRAGMA "
        "user_version = 1");
    ASSERT_EQ(version_of(path), "1");
    bytes = bytes_of_file(path);
  }
  TempFolder folder;
  fs::path path = folder / "a.ostia";
  std::string digest, bytes;
};

TEST_F(CaseVersion, OneIsBroughtUpToDateForEditing) {
  {
    CaseFile file = CaseFile::open(path);
    EXPECT_EQ(lumen::digest(*file.model()), digest);
    EXPECT_THAT(file.annotations()->measurements, IsEmpty());
    EXPECT_TRUE(replay(file).same());
    ASSERT_TRUE(file.redo());  // its changesets still fit
    file.annotate(added(analysis::MeasureKind::distance));
  }
  EXPECT_EQ(version_of(path), std::to_string(schema_version));
  CaseFile file = CaseFile::open(path);
  EXPECT_EQ(file.annotations()->measurements.size(), 1U);
  ASSERT_TRUE(file.undo());
  ASSERT_TRUE(file.undo());
  EXPECT_EQ(lumen::digest(*file.model()), digest);
}

TEST_F(CaseVersion, OneIsLeftAsItIsWhereItIsRead) {
  {
    const CaseFile file = CaseFile::open(path, OpenMode::read_only);
    EXPECT_EQ(lumen::digest(*file.model()), digest);
    EXPECT_THAT(file.annotations()->marks, IsEmpty());
    file.copy_to(folder / "b.ostia");
  }
  EXPECT_EQ(bytes_of_file(path), bytes);
  EXPECT_EQ(version_of(folder / "b.ostia"), std::to_string(schema_version));
  EXPECT_EQ(lumen::digest(*CaseFile::open(folder / "b.ostia").model()), digest);
}

TEST_F(CaseVersion, ADamagedOneIsNotChanged) {
  for (const char* damage : {"CREATE TABLE mark(x)", "DROP TABLE setting", "CREATE TABLE more(x)",
                             "ALTER TABLE node ADD COLUMN x"}) {
    write_bytes(path, bytes);
    case_version_sql(path, damage);
    EXPECT_THROW(CaseFile::open(path), InvalidInput) << damage;
    EXPECT_EQ(version_of(path), "1") << damage;
    EXPECT_EQ(Database(path.string(), SQLITE_OPEN_READONLY, "")
                  .text_of("SELECT count(*) FROM sqlite_schema WHERE name IN ('annotation', 'measurement')"),
              "0")
        << damage;
  }
}

TEST_F(CaseVersion, ANewerOneIsRefused) {
  case_version_sql(path, "PRAGMA user_version = " + std::to_string(schema_version + 1));
  for (const OpenMode mode : {OpenMode::read_only, OpenMode::read_write}) {
    try {
      CaseFile::open(path, mode);
      FAIL();
    } catch (const InvalidInput& e) {
      EXPECT_THAT(std::string(e.what()), HasSubstr("newer than this program's"));
    }
  }
}

TEST(CaseOfVersionTwo, KeepsItsMarksAndGetsTheReadersWord) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  MarkVessel plain = marked("seen");
  plain.mark.evaluable.clear();
  plain.mark.lesions.clear();
  {
    CaseFile file = CaseFile::create(path, tube_model());
    file.annotate(plain);
  }
  case_version_sql(path,
                   "DROP TABLE evaluability; DROP TABLE lesion; DROP TABLE step_stamp; DROP TABLE "
                   "image_axes; DROP TABLE pressure_input; DROP TABLE what_if; "
                   "DROP TABLE report_note; DROP TABLE report_version; PRAGMA user_version = 2");
  CaseFile file = CaseFile::open(path);
  ASSERT_EQ(file.annotations()->marks.size(), 1U);
  EXPECT_TRUE(same(file.annotations()->marks[0], plain.mark));
  file.annotate(marked("seen"));
  EXPECT_EQ(file.annotations()->marks[0].evaluable.size(), 2U);
  EXPECT_EQ(file.annotations()->marks[0].lesions.size(), 2U);
  ASSERT_TRUE(file.undo());
  EXPECT_TRUE(same(file.annotations()->marks[0], plain.mark));
  ASSERT_TRUE(file.undo());  // a step of the older program
  EXPECT_THAT(file.annotations()->marks, IsEmpty());
}

TEST(CaseOfVersionThree, KeepsTheReadersWordAndGetsThatOnLesions) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  MarkVessel older = marked("seen");
  older.mark.lesions.clear();
  {
    CaseFile file = CaseFile::create(path, tube_model());
    file.annotate(older);
  }
  case_version_sql(
      path,
      "DROP TABLE lesion; DROP TABLE step_stamp; DROP TABLE image_axes; DROP TABLE "
      "pressure_input; DROP TABLE what_if; DROP TABLE report_note; DROP TABLE report_version; PRAGMA "
      "user_version = 3");
  {
    CaseFile file = CaseFile::open(path);
    ASSERT_EQ(file.annotations()->marks.size(), 1U);
    EXPECT_TRUE(same(file.annotations()->marks[0], older.mark));
    file.annotate(marked("seen"));
  }
  CaseFile file = CaseFile::open(path);
  EXPECT_TRUE(same(file.annotations()->marks[0], marked("seen").mark));
  ASSERT_TRUE(file.undo());
  EXPECT_TRUE(same(file.annotations()->marks[0], older.mark));
  ASSERT_TRUE(file.redo());
  EXPECT_TRUE(same(file.annotations()->marks[0], marked("seen").mark));
}

TEST(CaseOfVersionFour, GetsTimesAndNamesFromTheNextStepOn) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  {
    CaseFile file = CaseFile::create(path, tube_model());
    file.apply(ring(10.0, 1.8));
  }
  case_version_sql(path,
                   "DROP TABLE step_stamp; DROP TABLE image_axes; DROP TABLE pressure_input; DROP TABLE "
                   "what_if; DROP TABLE report_note; DROP TABLE report_version; PRAGMA user_version = 4");
  CaseFile file = CaseFile::open(path);
  file.set_author("Dr. A");
  file.apply(renamed("two"));
  const std::vector<JournalEntry> journal = file.journal();
  ASSERT_EQ(journal.size(), 3U);
  EXPECT_EQ(journal[1].time_s, 0);
  EXPECT_EQ(journal[1].author, "");
  EXPECT_GT(journal[2].time_s, 1700000000);
  EXPECT_EQ(journal[2].author, "Dr. A");
}

TEST(CaseOfVersionFive, HasItsImageAsItsFileSaysAndNewOnesAsTheReaderDoes) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  const std::string hash(64, 'a');
  CaseFile::create(path, tube_model(), ImageReference{hash, "image-aaaaaaaa"});
  case_version_sql(path,
                   "DROP TABLE image_axes; DROP TABLE pressure_input; DROP TABLE what_if; "
                   "DROP TABLE report_note; DROP TABLE report_version; PRAGMA user_version = 5");
  EXPECT_EQ(CaseFile::open(path).image()->axes, "");
  EXPECT_EQ(version_of(path), std::to_string(schema_version));
  CaseFile::create(folder / "b.ostia", tube_model(), ImageReference{hash, "image-aaaaaaaa", "RPS"});
  EXPECT_EQ(CaseFile::open(folder / "b.ostia").image()->axes, "RPS");
  CaseFile::open(folder / "b.ostia").copy_to(folder / "c.ostia");
  EXPECT_EQ(CaseFile::open(folder / "c.ostia", OpenMode::read_only).image()->axes, "RPS");
  EXPECT_THROW(
      CaseFile::create(folder / "d.ostia", tube_model(), ImageReference{hash, "image-aaaaaaaa", "RLS"}),
      InvalidInput);
  case_version_sql(folder / "b.ostia", "UPDATE image_axes SET axes = 'LPS'");
  EXPECT_THROW(CaseFile::open(folder / "b.ostia"), InvalidInput);
}

TEST(CaseOfVersionSix, KeepsItsMarksAndGetsWhatPressuresAreTold) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  {
    CaseFile file = CaseFile::create(path, tube_model());
    file.annotate(marked("seen"));
  }
  case_version_sql(path,
                   "DROP TABLE pressure_input; DROP TABLE what_if; DROP TABLE report_note; DROP TABLE "
                   "report_version; PRAGMA user_version = 6");
  {
    const CaseFile file = CaseFile::open(path);
    EXPECT_TRUE(same(file.annotations()->marks.at(0), marked("seen").mark));
    EXPECT_THAT(file.annotations()->pressure.inputs, IsEmpty());
  }
  EXPECT_EQ(version_of(path), std::to_string(schema_version));
  CaseFile file = CaseFile::open(path);
  file.annotate(told_inputs());
  file.annotate(opened());
  EXPECT_EQ(file.annotations()->pressure.what_ifs, opened().what_ifs);
  ASSERT_TRUE(file.undo());
  ASSERT_TRUE(file.undo());
  ASSERT_TRUE(file.undo());  // a step of the older program
  EXPECT_THAT(file.annotations()->marks, IsEmpty());
}

TEST(CaseOfVersionSeven, KeepsWhatPressuresAreToldAndGetsWhatTheReportIs) {
  const TempFolder folder;
  const fs::path path = folder / "a.ostia";
  {
    CaseFile file = CaseFile::create(path, tube_model());
    file.annotate(told_inputs());
  }
  case_version_sql(path, "DROP TABLE report_note; DROP TABLE report_version; PRAGMA user_version = 7");
  {
    const CaseFile file = CaseFile::open(path);
    EXPECT_EQ(file.annotations()->pressure.inputs, told_inputs().inputs);
    EXPECT_EQ(file.annotations()->report, ReportNotes{});
  }
  EXPECT_EQ(version_of(path), std::to_string(schema_version));
  CaseFile file = CaseFile::open(path);
  file.annotate(written());
  EXPECT_EQ(file.annotations()->report.impression, written().text);
  ASSERT_TRUE(file.undo());
  ASSERT_TRUE(file.undo());  // a step of the older program
  EXPECT_THAT(file.annotations()->pressure.inputs, IsEmpty());
}

}  // namespace
}  // namespace ostia::session
