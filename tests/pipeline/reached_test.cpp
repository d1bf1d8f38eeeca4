#include "ostia/pipeline/reached.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

geometry::TriMesh closed_tube(double length_mm) {
  return geometry::surface_of(geometry::straight_tube(length_mm, 2.0), 0.5, false);
}

TEST(Reached, ASeedWithinOrAtTheEndOfTheLumenIsReached) {
  const geometry::TriMesh lumen = closed_tube(40.0);
  EXPECT_TRUE(
      unreached(lumen, Vec3(0, 0, 1), {Vec3(0, 0, 39), Vec3(0, 0, 42.5), Vec3(1, 1, 20)}, 1.0).empty());
}

TEST(Reached, ALumenThatEndsEarlyIsToldWithPlaceAndLength) {
  const std::vector<UnreachedPlace> missing =
      unreached(closed_tube(40.0), Vec3(0, 0, 1), {Vec3(0, 0, 30), Vec3(0, 0, 202)}, 1.0);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_NEAR(missing[0].missing_mm, 160.0, 0.1) << "the tube's round end is at 42 mm";
  EXPECT_NEAR(missing[0].reached.z(), 42.0, 0.1);
  EXPECT_EQ(missing[0].place, Vec3(0, 0, 202));
  EXPECT_THAT(text_of(missing[0]),
              ::testing::HasSubstr("42.0) mm, 160 mm before the target (0.0, 0.0, 202.0)"));
}

TEST(Reached, APartThatIsNotJoinedWithTheSourceIsNotReached) {
  geometry::TriMesh far = closed_tube(10.0);
  for (Vec3& p : far.points) p.z() += 60.0;
  const geometry::TriMesh both = geometry::merged(closed_tube(40.0), far);
  const std::vector<UnreachedPlace> missing = unreached(both, Vec3(0, 0, 1), {Vec3(0, 0, 65)}, 1.0);
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_NEAR(missing[0].missing_mm, 23.0, 0.1);
  EXPECT_TRUE(unreached(both, Vec3(0, 0, 64), {Vec3(0, 0, 69)}, 1.0).empty()) << "the source's part counts";
}

TEST(Reached, AxesReachTargetsWithinTwoRadiiOfTheirEnds) {
  const geometry::Centerline axis = geometry::straight_tube(40.0, 2.0).tubes.front().axis;
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, axis}};
  tree.vessels = {{0, "vessel", {0}}};
  EXPECT_TRUE(unreached(tree, {Vec3(0, 0, 40), Vec3(2, 0, 43), Vec3(0, 0, 45.9)}).empty());
  const auto missing = unreached(tree, {Vec3(0, 0, 46.1), Vec3(0, 0, 20)});
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_NEAR(missing[0].missing_mm, 6.1, 1e-9);
  EXPECT_NEAR(missing[1].missing_mm, 20.0, 1e-9) << "no vessel ends in the middle of another";
  EXPECT_EQ(texts_of(missing).size(), 2u);
}

}  // namespace
}  // namespace ostia::pipeline
