#include "ostia/cohort/measure_table.h"

#include "made_results.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* report = R"json({"v":1,"kind":"case report",
 "cad_rads":{"category":"4A","burden":{"segments":3}},"dominance":{"value":"right"},"all_checked":true,
 "vessels":[{"name":"LAD, \"mid\"","length_mm":101.5,"checked":true,"plaque":null}],
 "segments":[{"label":"pLAD (6)","least_area_mm2":2.25,"worst_percent":null}],
 "stenoses":[{"number":1,"diameter_percent":70.5,"plaque":{"plaque_mm3":12.125},"cad_rads":4}]})json";

constexpr const char* pressure = R"({"v":1,"kind":"ffr","outlets":[{"name":"RCA","ffr":0.5},
 {"name":"LAD","ffr":0.75}]})";

TEST(MeasureTables, HaveARowAValueAndNoneForWhatIsNotKnown) {
  const MadeCohort cohort("measure_rows", 3);
  cohort.make_all(0, report, pressure);
  cohort.make_all(1, report);
  cohort.make(1, 0, "another");  // all that follows is no longer trusted
  const MeasureTableResult made = write_measure_table(cohort.folder(), cohort.beside("tables"));
  EXPECT_EQ(made.scans, 3u);
  EXPECT_EQ(made.measured, 1u);
  EXPECT_EQ(made.values, 12u);
  const std::string rows = core::read_file(cohort.beside("tables") / "measures.csv");
  EXPECT_THAT(rows, HasSubstr(",patient,1,,cad_rads,4A,\n"));
  EXPECT_THAT(rows, HasSubstr(",vessel,1,\"LAD, \"\"mid\"\"\",length_mm,101.5,mm\n"));
  EXPECT_THAT(rows, HasSubstr(",segment,1,pLAD (6),least_area_mm2,2.25,mm2\n"));
  EXPECT_THAT(rows, HasSubstr(",stenosis,1,S1,plaque_mm3,12.125,mm3\n"));
  EXPECT_THAT(rows, HasSubstr(",outlet,2,LAD,ffr,0.75,1\n"));
  EXPECT_THAT(rows, Not(HasSubstr("worst_percent")));
  EXPECT_THAT(rows, Not(HasSubstr(cohort.scan(1))));
  const std::string scans = core::read_file(cohort.beside("tables") / "scans.csv");
  EXPECT_THAT(scans, HasSubstr(cohort.scan(0)));
  EXPECT_THAT(scans, HasSubstr(",mask,ok,stale,waiting,waiting,waiting,waiting\n"));
  EXPECT_THAT(scans, HasSubstr(",mask,waiting,waiting,waiting,waiting,waiting,waiting\n"));
}

TEST(MeasureTables, SqliteHoldsTheSameAndTheDictionaryNamesEveryMeasure) {
  const MadeCohort cohort("measure_sqlite", 1);
  cohort.make_all(0, report);
  write_measure_table(cohort.folder(), cohort.beside("tables"));
  const Store store(cohort.beside("tables") / "measures.sqlite", Store::Mode::read);
  Query area(store, "SELECT value, typeof(value) FROM measures WHERE measure = 'least_area_mm2'");
  ASSERT_TRUE(area.step());
  EXPECT_DOUBLE_EQ(area.real(0), 2.25);
  EXPECT_EQ(area.text(1), "real");
  Query untold(
      store,
      "SELECT count(*) FROM measures m WHERE NOT EXISTS (SELECT 1 FROM dictionary d WHERE d.level = m.level "
      "AND d.measure = m.measure AND d.unit = m.unit)");
  ASSERT_TRUE(untold.step());
  EXPECT_EQ(untold.integer(0), 0);
}

TEST(MeasureTables, AreTheSameBitsEachTimeAndReplaceThemselvesAlone) {
  const MadeCohort cohort("measure_again", 2);
  cohort.make_all(0, report);
  const auto files = [&](const std::string& name) {
    std::string all;
    for (const char* file : {"scans.csv", "measures.csv", "dictionary.csv", "measures.sqlite"})
      all += core::sha256_file(cohort.beside(name) / file);
    return all;
  };
  write_measure_table(cohort.folder(), cohort.beside("one"));
  write_measure_table(cohort.folder(), cohort.beside("two"));
  EXPECT_EQ(files("one"), files("two"));
  EXPECT_NO_THROW(write_measure_table(cohort.folder(), cohort.beside("one")));
  core::write_file(cohort.beside("two") / "mine.txt", "x");
  EXPECT_THROW(write_measure_table(cohort.folder(), cohort.beside("two")), InvalidInput);
}

TEST(MeasureTables, AReportThatIsNoneIsNamedAndNothingIsMade) {
  const MadeCohort cohort("measure_odd", 1);
  cohort.make_all(0, "no report");
  EXPECT_THROW(write_measure_table(cohort.folder(), cohort.beside("tables")), InvalidInput);
  EXPECT_FALSE(fs::exists(cohort.beside("tables")));
}

}  // namespace
}  // namespace ostia::cohort
