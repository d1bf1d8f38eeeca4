#include "ostia/cohort/statistics.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <cmath>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* known_measures =
    "scan,patient,level,entry,item,measure,value,unit\n"
    "p-1,p-a,segment,1,pLAD (6),least_area_mm2,4,mm2\n"
    "p-1,p-a,segment,2,pRCA (1),least_area_mm2,7,mm2\n"
    "p-2,p-b,segment,1,pLAD (6),least_area_mm2,2,mm2\n"
    "p-3,p-c,segment,1,pLAD (6),least_area_mm2,6,mm2\n"
    "p-4,p-d,segment,1,pLAD (6),least_area_mm2,3,mm2\n"
    "p-1,p-a,patient,1,,cad_rads,3,\n"
    "p-1,p-a,outlet,1,LAD,ffr,0.9,1\n"
    "p-2,p-b,outlet,1,LAD,ffr,0.7,1\n"
    "p-2,p-b,outlet,2,RCA,ffr,0.95,1\n"
    "p-3,p-c,outlet,1,LAD,ffr,0.85,1\n"
    "p-4,p-d,outlet,1,LAD,ffr,0.88,1\n";

class CohortStatistics : public ::testing::Test {
 protected:
  CohortStatistics() : folder_(ostia::testing::temporary_folder("statistics")) {
    core::write_file(folder_ / "tables/measures.csv", known_measures);
  }
  Statistics told(const std::string& reference) {
    core::write_file(folder_ / "reference.csv", reference);
    return write_statistics({folder_ / "tables", folder_ / "reference.csv", folder_ / "out"});
  }
  std::string refused(const std::string& reference) {
    try {
      told(reference);
    } catch (const InvalidInput& error) {
      EXPECT_FALSE(fs::exists(folder_ / "out"));
      return error.what();
    }
    return "taken";
  }
  fs::path folder_;
};

/// Differences 0.5, -0.5, 1.5 and 0.5 by hand: mean 0.5, standard deviation sqrt(2 / 3).
TEST_F(CohortStatistics, AgreementIsThatByHand) {
  const Statistics found = told(
      "scan,level,item,measure,value\np-1,segment,pLAD (6),least_area_mm2,3.5\n"
      "p-2,segment,pLAD (6),least_area_mm2,2.5\np-3,segment,pLAD (6),least_area_mm2,4.5\n"
      "p-4,segment,pLAD (6),least_area_mm2,2.5\np-4,segment,mLAD (7),least_area_mm2,1\n"
      "p-9,segment,pLAD (6),least_area_mm2,1\n");
  EXPECT_EQ(found.scans, 4u);
  EXPECT_EQ(found.unknown, 1u);
  ASSERT_EQ(found.agreements.size(), 1u);
  const MeasureInBoth& one = found.agreements[0];
  EXPECT_EQ(one.unit, "mm2");
  EXPECT_EQ(one.agreement.count, 4u);
  EXPECT_DOUBLE_EQ(one.agreement.bias, 0.5);
  EXPECT_NEAR(one.agreement.sd, std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_NEAR(one.agreement.upper_limit, 0.5 + 1.96 * std::sqrt(2.0 / 3.0), 1e-12);
  const std::string page = core::read_file(folder_ / "out/index.html");
  EXPECT_THAT(page, HasSubstr("least_area_mm2"));
  EXPECT_THAT(page, HasSubstr("limits of agreement"));
  EXPECT_THAT(core::read_file(folder_ / "out/agreement.csv"), HasSubstr("segment,least_area_mm2,mm2,4,0.5,"));
  EXPECT_THAT(core::read_file(folder_ / "out/pairs.csv"),
              HasSubstr("segment,least_area_mm2,p-2,pLAD (6),2.5,2\n"));
}

/// Two with ischemia, of areas 4 (the worst of p-1) and 2, and two without, of 6 and 3: three of four pairs
/// are in order. FFR 0.9 and 0.7 against 0.85 and 0.88: two of four.
TEST_F(CohortStatistics, AColumnOfZeroAndOneIsAnOutcome) {
  const Statistics found =
      told("scan,ischemia,age,least_area_mm2\np-1,1,61,5\np-2,1,57,2\np-3,0,70,6\np-4,0,49,3\n");
  ASSERT_EQ(found.outcomes.size(), 2u);
  const MeasureOfOutcome& area = found.outcomes[0];
  EXPECT_EQ(area.measure, "least_area_mm2");
  EXPECT_TRUE(area.low_is_worse);
  EXPECT_DOUBLE_EQ(area.roc.area, 0.75);
  EXPECT_DOUBLE_EQ(-area.roc.best.threshold, 2.0);
  EXPECT_EQ(found.outcomes[1].measure, "ffr");
  EXPECT_DOUBLE_EQ(found.outcomes[1].roc.area, 0.5);
  ASSERT_EQ(found.agreements.size(), 1u);  // the scan's worst against the column of this name
  EXPECT_EQ(found.agreements[0].level, "scan");
  EXPECT_DOUBLE_EQ(found.agreements[0].agreement.bias, -0.25);
  EXPECT_THAT(core::read_file(folder_ / "out/roc.csv"), HasSubstr("ischemia,least_area_mm2,mm2,2,2,0.75,"));
}

TEST_F(CohortStatistics, TablesOfAnotherCohortAreAReference) {
  const Statistics found = told(known_measures);
  ASSERT_EQ(found.agreements.size(), 2u);
  for (const MeasureInBoth& one : found.agreements) EXPECT_DOUBLE_EQ(one.agreement.bias, 0.0);
}

TEST_F(CohortStatistics, AReferenceThatCannotBeUsedIsNamedWithItsLine) {
  EXPECT_THAT(refused("id,ischemia\n1,0\n"), HasSubstr("no column `scan`"));
  EXPECT_THAT(refused("scan,ischemia\np-1,0,1\n"), HasSubstr("line 2: it has 3 cells"));
  EXPECT_THAT(refused("scan,ischemia\np-1,1\np-1,0\n"), HasSubstr("line 3: ischemia of p-1 is there twice"));
  EXPECT_THAT(refused("scan,note\np-1,\"open\n"), HasSubstr("a quotation has no end"));
  EXPECT_THAT(refused("scan,ischemia\np-1,1\np-2,1\n"), HasSubstr("it shares 2 scans"));
  EXPECT_THAT(refused("scan,age\np-8,61\n"), HasSubstr("it shares 0 scans"));
  fs::remove_all(folder_ / "tables");
  EXPECT_THAT(refused("scan,ischemia\np-1,1\n"), HasSubstr("`ostia cohort table` makes it"));
}

}  // namespace
}  // namespace ostia::cohort
