#include "ostia/geometry/polyline.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/segmentation/minimal_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::segmentation {
namespace {

double mean_distance(const std::vector<Vec3>& points, const std::vector<Vec3>& truth) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (geometry::closest(truth, p).point - p).norm();
  return sum / static_cast<double>(points.size());
}

/// The true tree without one vessel and what leaves it.
geometry::VesselTree without(const phantom::CoronaryTree& tree, std::int32_t gone) {
  phantom::CoronaryTree rest;
  rest.dominance = tree.dominance;
  std::vector<std::int32_t> removed{gone};
  for (const phantom::CoronaryVessel& v : tree.vessels) {
    const auto is_gone = [&](std::int32_t id) {
      return std::find(removed.begin(), removed.end(), id) != removed.end();
    };
    if (is_gone(v.id)) continue;
    if (is_gone(v.parent)) {
      removed.push_back(v.id);
    } else {
      rest.vessels.push_back(v);
    }
  }
  return phantom::vessel_tree(rest);
}

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
    const MinimalPath path =
        path_to_tree(image, axis.points[std::min(last, axis.size() - 1)], without(plan.tree, vessel.id));
    EXPECT_LT(mean_distance(path.points, axis.points), 0.15);             // asked for: 0.5
    EXPECT_LT((path.junction->point - axis.points.front()).norm(), 1.5);  // asked for: 2
    const auto parent = std::find_if(plan.tree.vessels.begin(), plan.tree.vessels.end(),
                                     [&](const phantom::CoronaryVessel& v) { return v.id == vessel.parent; });
    const Vec3 foot = geometry::closest(parent->axis.points, path.junction->point).point;
    EXPECT_LT((foot - path.junction->point).norm(), 0.05) << "joined to another vessel";
    EXPECT_GT(path.evidence, 0.8);
    EXPECT_NEAR(path.length_mm, axis.abscissa[std::min(last, axis.size() - 1)], 2.0);
  }
  EXPECT_EQ(tried, names.size());
}

}  // namespace
}  // namespace ostia::segmentation
