// A table is checked as a whole; then both folders are there, or neither.

#include "shared_data.h"
#include "store.h"

#include "ostia/cohort/cohort.h"
#include "ostia/cohort/pseudonym.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <fstream>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// With the files a.nrrd, b.nrrd and one whose name needs quoting.
fs::path folder_with(const std::string& name, const std::string& table) {
  const fs::path folder = ostia::testing::temporary_folder(name);
  for (const char* file : {"a.nrrd", "b.nrrd", "it's \"c\" $(touch x).nrrd"})
    core::write_file(folder / file, "x");
  core::write_file(folder / "table.csv", table);
  return folder;
}

std::vector<std::string> faults_of(const fs::path& folder) {
  std::vector<std::string> found;
  for (const RefusedRow& row : ScanTable::read(folder / "table.csv").check().refused)
    found.push_back(std::to_string(row.line) + " " + row.reason);
  return found;
}

std::string message_of(const fs::path& folder) {
  try {
    init_cohort({folder / "table.csv", folder / "study", false});
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(ScanTables, EveryBadRowIsNamedWithTheFirstFaultFound) {
  const fs::path folder = folder_with("cohort_rows",
                                      "id,scan,kind,series\n"       // 1
                                      "p1,a.nrrd,image,\n"          // 2
                                      "p1,b.nrrd,,\n"               // 3: id twice
                                      "p3,./a.nrrd,mask,\n"         // 4: scan twice
                                      "p4,gone.nrrd,,\n"            // 5
                                      "=cmd(),b.nrrd,,\n"           // 6
                                      "p6,\"two\nlines.nrrd\",,\n"  // 7
                                      "p7,b.nrrd,film,\n"           // 9
                                      "p8,b.nrrd\n"                 // 10
                                      ",b.nrrd,,\n"                 // 11
                                      "p10,pacs:1.2.3,,\n"          // 12
                                      "p11,b.nrrd,,1.2;3\n"         // 13
                                      "p\xff,b.nrrd,,\n"            // 14
                                      "p13,b.nrrd,,\n");
  EXPECT_THAT(faults_of(folder), ElementsAre("3 twice", "4 twice", "5 missing", "6 formula",
                                             "7 control character", "9 unknown kind", "10 width", "11 no id",
                                             "12 on a server", "13 no UID", "14 not UTF-8"));
  const InitResult refused = init_cohort({folder / "table.csv", folder / "study", false});
  EXPECT_FALSE(refused.made);
  EXPECT_EQ(refused.check.refused.size(), 11u);
  EXPECT_FALSE(fs::exists(folder / "study"));
  EXPECT_FALSE(fs::exists(folder / "study.private"));

  const InitResult made = init_cohort({folder / "table.csv", folder / "study", true});
  EXPECT_TRUE(made.made);
  EXPECT_EQ(made.scans, 2u);
}

TEST(ScanTables, WhatIsWrongWithAllOfItIsSaidOnce) {
  std::string wide = "id,scan";
  for (int i = 0; i < 10000; ++i) wide += ",c" + std::to_string(i);
  const auto said = [](const std::string& table) { return message_of(folder_with("cohort_table", table)); };
  EXPECT_THAT(said(wide + "\n"), HasSubstr("10002 columns"));
  EXPECT_THAT(said(""), HasSubstr("empty"));
  EXPECT_THAT(said("id,scan\n"), HasSubstr("no row"));
  EXPECT_THAT(said("id,file\np1,a.nrrd\n"), HasSubstr("id and scan"));
  EXPECT_THAT(said("id,scan,scan\np1,a.nrrd,\n"), HasSubstr("names"));
  EXPECT_THAT(said("id,scan\np1,\"a.nrrd\n"), HasSubstr("line 2"));
  EXPECT_THAT(said("id,scan\np1,gone\n"), ::testing::IsEmpty());  // rows are no exception
}

TEST(CohortFolder, HoldsPseudonymsAndThePrivateOneWhatTheyStandFor) {
  const std::string odd = "it's \"c\" $(touch x).nrrd";
  const fs::path folder = folder_with("cohort_init",
                                      "\xef\xbb\xbfid,age,scan,patient\r\nJane Doe 1,61,a.nrrd,Jane Doe\r\n"
                                      "Jane Doe 2,63,b.nrrd,Jane Doe\r\n"
                                      "\"O'Neil, \"\"J\"\"\",50,\"it's \"\"c\"\" $(touch x).nrrd\",\r\n");
  const InitResult made = init_cohort({folder / "table.csv", folder / "study/", false});
  EXPECT_EQ(made.scans, 3u);
  EXPECT_THAT(made.check.unused_columns, ElementsAre("age"));
  EXPECT_EQ(made.private_folder, folder / "study.private");
  for (const char* name : {"inputs", "cases", "lumens", "meshes", "flow", "measures", "logs", "pictures"})
    EXPECT_TRUE(fs::is_directory(folder / "study" / name)) << name;
  const auto mode = [&](const fs::path& path) {
    return static_cast<int>(fs::status(folder / "study.private" / path).permissions());
  };
  EXPECT_EQ(mode(""), 0700);
  EXPECT_EQ(mode("key"), 0600);
  EXPECT_EQ(mode("sources.sqlite"), 0600);

  const std::string shared = core::read_file(folder / "study" / database_name);
  for (const char* secret : {"Jane", "Neil", "a.nrrd", "touch"})
    EXPECT_EQ(shared.find(secret), std::string::npos);

  const Pseudonyms pseudonyms(core::read_file(folder / "study.private/key").substr(0, 64));
  const Store cohort(folder / "study" / database_name, Store::Mode::read);
  Query scans(cohort, "SELECT pseudonym, patient FROM scan ORDER BY number");
  ASSERT_TRUE(scans.step());
  EXPECT_EQ(scans.text(0), pseudonyms.of("scan Jane Doe 1"));
  const std::string patient = scans.text(1);
  ASSERT_TRUE(scans.step());
  EXPECT_EQ(scans.text(1), patient);  // two scans of one
  const Store sources(folder / "study.private/sources.sqlite", Store::Mode::read);
  Query odd_one(sources, "SELECT scan, id FROM source WHERE number = 3");
  ASSERT_TRUE(odd_one.step());
  EXPECT_EQ(odd_one.text(0), (folder / odd).string());
  EXPECT_EQ(odd_one.text(1), "O'Neil, \"J\"");
}

TEST(CohortFolder, ASecondOneInTheSamePlaceIsRefusedAndTheFirstStays) {
  const fs::path folder = folder_with("cohort_twice", "id,scan\np1,a.nrrd\n");
  init_cohort({folder / "table.csv", folder / "study", false});
  const std::string key = core::read_file(folder / "study.private/key");
  EXPECT_THAT(message_of(folder), HasSubstr("holds a cohort already"));
  fs::remove_all(folder / "study");
  EXPECT_THAT(message_of(folder), HasSubstr("only key"));
  EXPECT_EQ(core::read_file(folder / "study.private/key"), key);
}

TEST(CohortFolder, ACancelledBeginningLeavesNothing) {
  std::string table = "id,scan,series\n";
  for (int i = 0; i < 3000; ++i) table += "p" + std::to_string(i) + ",a.nrrd," + std::to_string(i) + "\n";
  const fs::path folder = folder_with("cohort_cancelled", table);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(init_cohort({folder / "table.csv", folder / "study", false}, task), Cancelled);
  EXPECT_FALSE(fs::exists(folder / "study"));
  EXPECT_FALSE(fs::exists(folder / "study.private"));
  EXPECT_EQ(init_cohort({folder / "table.csv", folder / "study", false}).scans, 3000u);
}

}  // namespace
}  // namespace ostia::cohort
