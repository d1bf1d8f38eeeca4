#include "ostia/coronary/tree_growth.h"
#include "ostia/phantom/phantom_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::coronary {
namespace {

/// The arteries near the ostia, among veins, chambers and fat, with plaques.
TEST(TreeGrowthInAPhantom, FollowsTheProximalArteriesAlone) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::tiny;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const phantom::Scan scan = phantom::scan_case(plan);
  // The first vessels' starts stand for the search of the ostia: the root is cut by this small field.
  Aorta aorta;
  aorta.lumen_hu = 400.0;
  std::vector<Ostium> ostia;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    if (vessel.parent >= 0) continue;
    Ostium made;
    made.place = vessel.axis.points.front();
    made.direction = (vessel.axis.points[10] - vessel.axis.points[0]).normalized();
    ostia.push_back(made);
  }
  const GrownTree tree = grow_tree(scan.image, aorta, ostia);
  std::size_t points = 0, inside = 0;
  const imaging::Geometry& grid = scan.labels.geometry;
  for (const GrownBranch& branch : tree.branches)
    for (const Vec3& point : branch.points) {
      const Vec3 at = grid.index(point);
      const auto label = static_cast<phantom::Label>(
          scan.labels(std::lround(at.x()), std::lround(at.y()), std::lround(at.z())));
      ++points;
      inside += label == phantom::Label::coronary_lumen || label == phantom::Label::soft_plaque ||
                        label == phantom::Label::fibrous_plaque ||
                        label == phantom::Label::calcified_plaque || label == phantom::Label::aorta ||
                        label == phantom::Label::vessel_wall
                    ? 1
                    : 0;
    }
  ASSERT_GT(points, 100U);
  EXPECT_EQ(inside, points) << "something that is no artery was followed";

  double longest_gap_mm = 0.0, asked_mm = 0.0;
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    double gap = 0.0;
    for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
      const Vec3& place = vessel.axis.points[i];
      // Vessels that only come back into the field have no way to it.
      if (vessel.parent >= 0 || vessel.axis.abscissa[i] > 25.0 || !grid.contains(place)) break;
      double nearest = std::numeric_limits<double>::infinity();
      for (const GrownBranch& branch : tree.branches)
        for (const Vec3& point : branch.points) nearest = std::min(nearest, (point - place).norm());
      gap = nearest < 1.0 ? 0.0 : gap + 0.5;
      longest_gap_mm = std::max(longest_gap_mm, gap);
      asked_mm += 0.5;
    }
  }
  EXPECT_GT(asked_mm, 40.0);
  EXPECT_LE(longest_gap_mm, 1.5);
}

}  // namespace
}  // namespace ostia::coronary
