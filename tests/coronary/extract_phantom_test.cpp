#include "coarse_scan.h"
#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/coronary/extract.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace ostia::coronary {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A whole heart at 0.7 x 0.7 x 0.9 mm, with plaques.
struct Heart {
  phantom::CasePlan plan;
  imaging::ImageVolume image;
};
const Heart& extract_phantom_heart() {
  static const Heart made = [] {
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    Heart result{phantom::plan_case(options), {}};
    result.image = ostia::testing::kept_scan(result.plan).image;
    return result;
  }();
  return made;
}

double off_axes(const geometry::VesselTree& tree, const Vec3& place) {
  double nearest = 1e9;
  for (const geometry::TreeSegment& segment : tree.segments)
    nearest = std::min(nearest, (geometry::closest(segment.axis.points, place).point - place).norm());
  return nearest;
}

const geometry::Vessel* named(const geometry::VesselTree& tree, const std::string& name) {
  for (const geometry::Vessel& vessel : tree.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

TEST(ExtractFromAPhantom, FindsCentresAndNamesTheArteries) {
  core::TaskContext task;
  const Extraction found = extract(extract_phantom_heart().image, {}, task);
  EXPECT_EQ(task.progress(), 1.0);
  EXPECT_EQ(task.stage(), "naming the vessels");
  const geometry::VesselTree& tree = found.vessels.tree;
  const geometry::VesselTree truth = phantom::vessel_tree(extract_phantom_heart().plan.tree);
  EXPECT_EQ(geometry::find_fault(tree).value_or("none"), "none");
  EXPECT_EQ(geometry::roots(tree).size(), 2U);
  EXPECT_EQ(found.notes.size(), tree.vessels.size());

  double asked = 0.0, reached = 0.0;
  for (const phantom::CoronaryVessel& vessel : extract_phantom_heart().plan.tree.vessels)
    for (std::size_t i = 0; i < vessel.axis.size(); i += 5) {
      if (vessel.axis.radius[i] < 0.5) continue;
      asked += 1.0;
      reached += off_axes(tree, vessel.axis.points[i]) < 1.0 ? 1.0 : 0.0;
    }
  double points = 0.0, within = 0.0, off = 0.0;
  for (const geometry::TreeSegment& segment : tree.segments)
    for (const Vec3& point : segment.axis.points) {
      const double away = off_axes(truth, point);
      points += 1.0;
      within += away < 1.0 ? 1.0 : 0.0;
      off += std::min(away, 1.0);
    }
  std::printf("of the true axes %.1f %% found, of the found ones %.1f %% true, %.3f mm off in the mean\n",
              100.0 * reached / asked, 100.0 * within / points, off / points);
  EXPECT_GT(reached / asked, 0.95);
  EXPECT_GT(within / points, 0.98);
  EXPECT_LT(off / points, 0.12);

  int right = 0;
  for (const phantom::CoronaryVessel& vessel : extract_phantom_heart().plan.tree.vessels) {
    const geometry::Vessel* const same = named(tree, vessel.name);
    if (same == nullptr) continue;
    const Vec3 end = geometry::vessel_axis(tree, *same).points.back();
    right += (geometry::closest(vessel.axis.points, end).point - end).norm() < 1.0 ? 1 : 0;
  }
  EXPECT_EQ(right, static_cast<int>(extract_phantom_heart().plan.tree.vessels.size()))
      << "vessels with their right names";
  EXPECT_EQ(found.vessels.dominance, CoronaryDominance::right);
}

TEST(ExtractFromAPhantom, TheSameForAnyNumberOfThreads) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  phantom::CasePlan plan = phantom::plan_case(options);
  ostia::testing::make_coarse(plan.options.scan, 1.2);
  const imaging::ImageVolume image = ostia::testing::kept_scan(plan).image;
  core::set_max_threads(1);
  const Extraction alone = extract(image);
  core::set_max_threads(3);
  const Extraction together = extract(image);
  core::set_max_threads(0);
  EXPECT_EQ(alone.warnings, together.warnings);
  ASSERT_GE(alone.vessels.tree.vessels.size(), 3U);
  ASSERT_EQ(alone.vessels.tree.vessels.size(), together.vessels.tree.vessels.size());
  for (std::size_t i = 0; i < alone.vessels.tree.vessels.size(); ++i)
    EXPECT_EQ(alone.vessels.tree.vessels[i].name, together.vessels.tree.vessels[i].name);
  ASSERT_EQ(alone.vessels.tree.segments.size(), together.vessels.tree.segments.size());
  for (std::size_t i = 0; i < alone.vessels.tree.segments.size(); ++i) {
    EXPECT_EQ(alone.vessels.tree.segments[i].axis.points, together.vessels.tree.segments[i].axis.points);
    EXPECT_EQ(alone.vessels.tree.segments[i].axis.radius, together.vessels.tree.segments[i].axis.radius);
  }
}

TEST(ExtractFromAPhantom, AMissingRightCoronaryIsTold) {
  Heart half = extract_phantom_heart();
  const imaging::Geometry& grid = half.image.geometry;
  for (const phantom::CoronaryVessel& vessel : half.plan.tree.vessels) {
    if (vessel.name != "RCA") continue;
    // Fat instead of its first centimetres.
    for (std::size_t n = 15; n < 400; n += 5) {
      const Vec3 at = grid.index(vessel.axis.points[n]);
      for (int k = -5; k <= 5; ++k)
        for (int j = -5; j <= 5; ++j)
          for (int i = -5; i <= 5; ++i)
            half.image(std::lround(at.x()) + i, std::lround(at.y()) + j, std::lround(at.z()) + k) = -90;
    }
  }
  const Extraction found = extract(half.image);
  EXPECT_EQ(geometry::roots(found.vessels.tree).size(), 1U);
  EXPECT_NE(named(found.vessels.tree, "LAD"), nullptr);
  EXPECT_EQ(named(found.vessels.tree, "RCA"), nullptr);
  EXPECT_THAT(found.warnings, Contains(HasSubstr("one coronary artery alone was found")));
  EXPECT_THAT(found.warnings, Contains(HasSubstr("no right coronary artery")));
}

TEST(ExtractFromAPhantom, RefusesWhatItCannotUseAndStopsWhenTold) {
  ExtractOptions options;
  options.axes.step_mm = 0.0;
  EXPECT_THROW(extract(extract_phantom_heart().image, options), InvalidInput);
  options = {};
  options.labels.least_confidence = 2.0;
  EXPECT_THROW(extract(extract_phantom_heart().image, options), InvalidInput);
  EXPECT_THROW(extract({}), InvalidInput);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(extract(extract_phantom_heart().image, {}, task), Cancelled);
  imaging::ImageVolume muscle = extract_phantom_heart().image;
  std::fill(muscle.voxels.begin(), muscle.voxels.end(), static_cast<std::int16_t>(60));
  EXPECT_THROW(extract(muscle), InvalidInput);
}

}  // namespace
}  // namespace ostia::coronary
