#include "shared_data.h"

#include "ostia/io/wfdb_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace ostia::io {
namespace {

using ::testing::IsEmpty;

// The headers give first samples and sums of all samples, which the reader compares.
TEST(WfdbReal, ReadsTheArrhythmiaRecordWithItsBeats) {
  OSTIA_REQUIRE_SHARED(folder, "ecg");
  const WfdbRecord read = read_wfdb(folder / "100.hea");
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_EQ(read.record.leads.size(), 2U);
  EXPECT_EQ(read.record.samples(), 650000U);
  EXPECT_EQ(read.record.samples_per_second, 360.0);
  EXPECT_EQ(read.record.leads[0].name, "MLII");
  EXPECT_DOUBLE_EQ(read.record.leads[0].values[0], (995 - 1024) / 200.0);
  EXPECT_DOUBLE_EQ(read.record.leads[1].values[0], (1011 - 1024) / 200.0);

  const auto beats = read_wfdb_beats(folder / "100.atr");
  EXPECT_EQ(beats.size(), 2273U);  // as published
  const auto count = [&](char kind) {
    return std::count_if(beats.begin(), beats.end(), [&](const auto& beat) { return beat.kind == kind; });
  };
  EXPECT_EQ(count('N'), 2239);
  EXPECT_EQ(count('A'), 33);
  EXPECT_EQ(count('V'), 1);
}

TEST(WfdbReal, ReadsTwelveLeadsAndFrankLeadsOfTwoFiles) {
  OSTIA_REQUIRE_SHARED(folder, "ecg");
  const WfdbRecord read = read_wfdb(folder / "s0010_re.hea");
  EXPECT_THAT(read.warnings, IsEmpty());
  ASSERT_EQ(read.record.leads.size(), 15U);
  EXPECT_EQ(read.record.samples(), 38400U);
  EXPECT_EQ(read.record.leads[14].name, "vz");
  EXPECT_DOUBLE_EQ(read.record.leads[0].values[0], -489 / 2000.0);
  EXPECT_DOUBLE_EQ(read.record.leads[13].values[0], 120 / 2000.0);
  for (std::size_t i = 0; i < 38400; i += 100)  // Einthoven: I + III = II
    EXPECT_NEAR(read.record.leads[0].values[i] + read.record.leads[2].values[i],
                read.record.leads[1].values[i], 2e-3);
}

}  // namespace
}  // namespace ostia::io
