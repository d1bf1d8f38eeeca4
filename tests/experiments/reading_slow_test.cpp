#include "ostia/experiments/reading.h"

#include <gtest/gtest.h>

namespace ostia::experiments {
namespace {

TEST(ReadingPatient, IsReadFromBothStarts) {
  ReadingPatients options;
  options.patients = 1;
  options.voxel_mm = 2.0;
  options.reader.most_actions = 6;
  const std::vector<ReadingRun> runs = read_patients(options);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].patient, "seed 1");
  EXPECT_TRUE(runs[0].automatic);
  EXPECT_FALSE(runs[1].automatic);
  EXPECT_EQ(runs[0].actions.front().act, ReadingAct::search);
  EXPECT_EQ(runs[1].count(ReadingAct::search), 0U);
  EXPECT_EQ(runs[1].actions.front().act, ReadingAct::addition);
  EXPECT_EQ(runs[1].actions.size(), 6U);
  EXPECT_TRUE(runs[1].gave_up);
  EXPECT_EQ(runs[1].before.share_beyond(), 1.0);
}

}  // namespace
}  // namespace ostia::experiments
