#include "ostia/coronary/labels.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace ostia::coronary {
namespace {

/// A tree of straight segments, each from the end of an earlier one (or from a place of its own) to a place.
geometry::VesselTree sticks(const std::vector<std::pair<int, Vec3>>& ends, const std::vector<Vec3>& roots) {
  geometry::VesselTree tree;
  for (std::size_t r = 0; r < roots.size(); ++r)
    tree.nodes.push_back({static_cast<std::int32_t>(r), roots[r]});
  std::vector<std::vector<std::int32_t>> ways(roots.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto from = static_cast<std::int32_t>(ends[i].first);
    const auto to = static_cast<std::int32_t>(tree.nodes.size());
    geometry::TreeSegment segment;
    segment.id = static_cast<std::int32_t>(i);
    segment.from = from;
    segment.to = to;
    segment.axis.points = {geometry::node(tree, from).position, ends[i].second};
    segment.axis.radius = {1.0, 1.0};
    geometry::complete(segment.axis);
    tree.nodes.push_back({to, ends[i].second});
    tree.segments.push_back(std::move(segment));
    ways.push_back(ways[static_cast<std::size_t>(from)]);
    ways.back().push_back(static_cast<std::int32_t>(i));
  }
  for (const std::int32_t end : geometry::ends(tree))
    tree.vessels.push_back({end, "given", ways[static_cast<std::size_t>(end)]});
  return tree;
}

TEST(Labels, OneBranchIsNoFault) {
  const LabelledTree up = label_branches(sticks({{0, Vec3(0.0, 0.0, 30.0)}}, {Vec3::Zero()}));
  ASSERT_EQ(up.tree.vessels.size(), 1U);
  EXPECT_EQ(up.tree.vessels[0].name, "V1") << "no coronary artery goes straight up";
  EXPECT_EQ(up.labels.size(), 1U);
  EXPECT_EQ(up.dominance, CoronaryDominance::unknown);
  EXPECT_FALSE(up.warnings.empty());
  EXPECT_EQ(geometry::find_fault(up.tree).value_or("none"), "none");
}

TEST(Labels, AShortTreeOfOnePointAWayIsNoFault) {
  const LabelledTree tiny = label_branches(sticks(
      {{0, Vec3(0.2, 0.0, 0.0)}, {1, Vec3(0.3, 0.1, 0.0)}, {1, Vec3(0.3, -0.1, 0.0)}}, {Vec3::Zero()}));
  EXPECT_EQ(tiny.tree.vessels.size(), 2U);
  for (const geometry::Vessel& vessel : tiny.tree.vessels) EXPECT_EQ(vessel.name.front(), 'V');
}

TEST(Labels, RefusesWhatIsNoTree) {
  EXPECT_THROW(label_branches({}), InvalidInput);
  geometry::VesselTree broken = sticks({{0, Vec3(0.0, 0.0, 30.0)}}, {Vec3::Zero()});
  broken.segments[0].to = 77;
  EXPECT_THROW(label_branches(broken), InvalidInput);
  const geometry::VesselTree good = sticks({{0, Vec3(0.0, 0.0, 30.0)}}, {Vec3::Zero()});
  LabelOptions options;
  options.least_confidence = 1.5;
  EXPECT_THROW(label_branches(good, options), InvalidInput);
  options = {};
  options.heart.long_axis = Vec3(Vec3::Zero());
  EXPECT_THROW(label_branches(good, options), InvalidInput);
  options.heart.long_axis = Vec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  EXPECT_THROW(label_branches(good, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::coronary
