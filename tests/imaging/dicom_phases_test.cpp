#include "dicom_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

DicomSlice slice_at(double depth, const std::function<void(DicomHeader&)>& change) {
  auto header = std::make_shared<DicomHeader>();
  header->frames.resize(1);
  static int count = 0;
  header->sop_instance = "1." + std::to_string(++count);
  change(*header);
  DicomSlice slice;
  slice.header = header;
  slice.depth_mm = depth;
  return slice;
}

TEST(SplitPhases, LeavesASimpleStackAlone) {
  std::vector<DicomSlice> slices;
  for (int k = 5; k > 0; --k) slices.push_back(slice_at(k, [](DicomHeader&) {}));
  const DicomPhases phases = split_phases(slices);
  ASSERT_EQ(phases.parts.size(), 1u);
  EXPECT_EQ(phases.labels[0], "");
  EXPECT_EQ(phases.parts[0].front().depth_mm, 1.0);
}

TEST(SplitPhases, ByCardiacPhase) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 6; ++k) {
    for (const double percent : {70.0, 40.0}) {
      slices.push_back(slice_at(k, [&](DicomHeader& h) { h.frames[0].cardiac_percent = percent; }));
    }
  }
  const DicomPhases phases = split_phases(slices);
  ASSERT_EQ(phases.parts.size(), 2u);
  EXPECT_EQ(phases.labels[0], "cardiac phase 40 %");
  EXPECT_EQ(phases.parts[0].size(), 6u);
  EXPECT_TRUE(phases.warnings.empty());
}

TEST(SplitPhases, TimesThatDifferEverywhereAreTakenByTheirOrder) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 4; ++k) {
    for (int t = 0; t < 3; ++t) {
      slices.push_back(
          slice_at(k, [&](DicomHeader& h) { h.frames[0].trigger_time_ms = 100.0 * t + 7.0 * k; }));
    }
  }
  const DicomPhases phases = split_phases(slices);
  ASSERT_EQ(phases.parts.size(), 3u);
  for (std::size_t t = 0; t < 3; ++t) {
    ASSERT_EQ(phases.parts[t].size(), 4u);
    for (const DicomSlice& s : phases.parts[t]) {
      EXPECT_EQ(*s.info().trigger_time_ms, 100.0 * static_cast<double>(t) + 7.0 * s.depth_mm);
    }
  }
  EXPECT_THAT(phases.warnings, Contains(HasSubstr("order of their trigger time")));
}

TEST(SplitPhases, AMissingPhaseIsTold) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 4; ++k) {
    for (int p = 0; p < 20; ++p) {
      if (p == 8) continue;
      slices.push_back(slice_at(k, [&](DicomHeader& h) { h.frames[0].cardiac_percent = 5.0 * p; }));
    }
  }
  const DicomPhases phases = split_phases(slices);
  EXPECT_EQ(phases.parts.size(), 19u);
  EXPECT_THAT(phases.warnings,
              Contains(HasSubstr("missing between cardiac phase 35 % and cardiac phase 45 %")));
}

TEST(SplitPhases, PhasesOfUnequalLength) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 6; ++k) {
    for (int p = 0; p < 3; ++p) {
      if (k == 5 && p == 1) continue;
      slices.push_back(slice_at(k, [&](DicomHeader& h) { h.frames[0].temporal_position = p + 1; }));
    }
  }
  const DicomPhases phases = split_phases(slices);
  ASSERT_EQ(phases.parts.size(), 3u);
  EXPECT_EQ(phases.parts[1].size(), 5u);
  EXPECT_THAT(phases.warnings, Contains(HasSubstr("from 5 to 6 slices")));
}

TEST(SplitPhases, PhasesOnDifferentGrids) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 6; ++k) {
    for (int p = 0; p < 3; ++p) {
      const double shift = p == 2 ? 0.5 : 0.0;
      slices.push_back(slice_at(k + shift, [&](DicomHeader& h) { h.frames[0].temporal_position = p + 1; }));
    }
  }
  const DicomPhases phases = split_phases(slices);
  ASSERT_EQ(phases.parts.size(), 3u);
  EXPECT_THAT(phases.warnings, Contains(HasSubstr("different grids")));
}

TEST(SplitPhases, CopiesAreNoPhases) {
  std::vector<DicomSlice> slices;
  for (int k = 0; k < 4; ++k) {
    for (int copy = 0; copy < 2; ++copy) {
      slices.push_back(slice_at(k, [&](DicomHeader& h) {
        h.sop_instance = "1.2." + std::to_string(k);
        h.content_time = 10.0 * k;
        h.instance_number = k;
      }));
    }
  }
  EXPECT_EQ(split_phases(slices).parts.size(), 1u);
}

}  // namespace
}  // namespace ostia::imaging
