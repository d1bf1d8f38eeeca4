#include "removed_branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::segmentation {
namespace {

TEST(MinimalPath, RemovedBranchesOfAPhantomAreFoundAgain) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  phantom::CasePlan plan = phantom::plan_case(options);
  // The part of the heart that holds the left side branches, at a clinical resolution.
  const std::vector<std::string> names{"D1", "D2", "OM1"};
  const double reach_mm = 26.0;
  geometry::Box3 box;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    if (std::find(names.begin(), names.end(), vessel.name) == names.end()) continue;
    for (std::size_t i = 0; i < vessel.axis.size() && vessel.axis.abscissa[i] < reach_mm; ++i)
      box.extend(vessel.axis.points[i]);
  }
  imaging::Geometry& grid = plan.options.scan.grid;
  grid.spacing = Vec3(0.45, 0.45, 0.5);
  grid.direction.setIdentity();
  grid.origin = box.min() - Vec3::Constant(6.0);
  for (int d = 0; d < 3; ++d) {
    grid.size[static_cast<std::size_t>(d)] =
        static_cast<std::int64_t>(std::ceil((box.sizes()[d] + 12.0) / grid.spacing[d]));
  }
  const imaging::ImageVolume image = phantom::scan_case(plan).image;
  std::size_t tried = 0;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    if (std::find(names.begin(), names.end(), vessel.name) == names.end()) continue;
    SCOPED_TRACE(vessel.name);
    const auto& axis = vessel.axis;
    const auto last = static_cast<std::size_t>(
        std::lower_bound(axis.abscissa.begin(), axis.abscissa.end(), reach_mm - 1.0) - axis.abscissa.begin());
    ++tried;
    const testing::FoundBranch found = testing::found_again(image, plan.tree, vessel, last);
    EXPECT_LT(found.off_axis_mm, 0.15);     // asked for: 0.5
    EXPECT_LT(found.off_junction_mm, 1.5);  // asked for: 2
    EXPECT_LT(found.off_parent_mm, 0.05) << "joined to another vessel";
    EXPECT_GT(found.path.evidence, 0.8);
    EXPECT_NEAR(found.path.length_mm, axis.abscissa[std::min(last, axis.size() - 1)], 2.0);
  }
  EXPECT_EQ(tried, names.size());
}

}  // namespace
}  // namespace ostia::segmentation
