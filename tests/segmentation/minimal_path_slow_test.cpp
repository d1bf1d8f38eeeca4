// All branches of whole phantom hearts, taken away one after the other and found again by one click each: the
// figures of docs/methods/minimal-path.md.

#include "removed_branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace ostia::segmentation {
namespace {

struct Heart {
  std::uint64_t seed;
  phantom::Preset preset;
  double most_off_axis_mm;
};

/// What a clinician clicks at: where the branch has become as thin as this.
constexpr double end_radius_mm = 0.6;
constexpr double least_length_mm = 5.0;

class RemovedBranches : public ::testing::TestWithParam<Heart> {};

TEST_P(RemovedBranches, OfAWholeHeartAreFoundAgain) {
  phantom::CaseOptions options;
  options.seed = GetParam().seed;
  options.preset = GetParam().preset;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const imaging::ImageVolume image = phantom::scan_case(plan).image;
  std::vector<double> off_axis, off_junction, took;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    if (vessel.parent < 0) continue;
    SCOPED_TRACE(vessel.name);
    std::size_t last = vessel.axis.size() - 1;
    while (last > 0 && vessel.axis.radius[last] < end_radius_mm) --last;
    if (vessel.axis.abscissa[last] < least_length_mm) continue;  // thin from its beginning
    const auto begin = std::chrono::steady_clock::now();
    const testing::FoundBranch found = testing::found_again(image, plan.tree, vessel, last);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(found.off_axis_mm, GetParam().most_off_axis_mm);
    EXPECT_LT(found.off_junction_mm, 2.0);
    EXPECT_LT(found.off_parent_mm, 0.05) << "joined to another vessel";
    off_axis.push_back(found.off_axis_mm);
    off_junction.push_back(found.off_junction_mm);
    took.push_back(ms.count());
  }
  ASSERT_GE(off_axis.size(), 6u);
  const auto say = [](const char* what, std::vector<double> values) {
    std::sort(values.begin(), values.end());
    std::printf("  %s: %.2f to %.2f, median %.2f\n", what, values.front(), values.back(),
                values[values.size() / 2]);
  };
  std::printf("%zu branches\n", off_axis.size());
  say("off the axis, mean of each (mm)", off_axis);
  say("off the junction (mm)", off_junction);
  say("time of each (ms)", took);
}

INSTANTIATE_TEST_SUITE_P(Phantoms, RemovedBranches,
                         ::testing::Values(Heart{1, phantom::Preset::full, 0.2},
                                           Heart{2, phantom::Preset::full, 0.2},
                                           Heart{1, phantom::Preset::small, 0.2}));

}  // namespace
}  // namespace ostia::segmentation
