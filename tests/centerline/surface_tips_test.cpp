#include "ostia/centerline/surface_tips.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::centerline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

TriMesh closed(const geometry::AnalyticShape& shape) {
  return geometry::surface_of(shape, 0.4, false);
}

double nearest(const std::vector<SurfaceTip>& tips, const Vec3& place) {
  double least = 1e9;
  for (const SurfaceTip& tip : tips) least = std::min(least, (tip.inside - place).norm());
  return least;
}

TEST(SurfaceTips, AreTheEndsOfATube) {
  const auto tips = find_tips(closed(geometry::straight_tube(40.0, 2.0)));
  ASSERT_EQ(tips.size(), 2u);
  for (const double z : {0.0, 40.0}) EXPECT_LT(nearest(tips, Vec3(0.0, 0.0, z)), 2.0);
  for (const SurfaceTip& tip : tips) {
    EXPECT_NEAR(tip.radius_mm, 2.0, 0.5);
    EXPECT_GT(tip.length_mm, 40.0);
  }
}

TEST(SurfaceTips, SeenFromAPlaceAreAllOtherEnds) {
  const auto shape = geometry::coronary_like_tree();
  const Vec3 root = shape.tubes[0].axis.points.front();
  const auto tips = find_tips(closed(shape), root);
  EXPECT_EQ(tips.size(), 4u);
  EXPECT_GT(nearest(tips, root), 5.0);
  for (const geometry::AnalyticTube& tube : shape.tubes)
    EXPECT_LT(nearest(tips, tube.axis.points.back()), 1.5) << tube.name;
  EXPECT_EQ(find_tips(closed(shape)).size(), 5u);
}

TEST(SurfaceTips, OfAYTellHowLongTheirBranchesAre) {
  const auto shape = geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0);
  const auto tips = find_tips(closed(shape), Vec3(0.0, 0.0, -20.0));
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_NEAR(tips[1].length_mm, 15.0, 6.0);  // less the way to the crotch, and the dome at its end
}

TEST(SurfaceTips, ABallHasNone) {
  geometry::AnalyticShape ball = geometry::straight_tube(0.5, 5.0);
  EXPECT_TRUE(find_tips(closed(ball)).empty());
}

TEST(SurfaceTips, ABallOnANeckNarrowsAndATubeDoesNot) {
  geometry::AnalyticShape sac = geometry::straight_tube(20.0, 1.0);
  const geometry::AnalyticShape ball = geometry::straight_tube(0.5, 4.0);
  sac.tubes.push_back(ball.tubes.front());
  sac.box.extend(ball.box);
  const auto of_sac = find_tips(closed(sac), Vec3(0.0, 0.0, 20.0));
  ASSERT_FALSE(of_sac.empty());
  for (const SurfaceTip& tip : of_sac) EXPECT_LT(tip.neck, 0.7);
  const auto of_y = find_tips(closed(geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0)), Vec3(0.0, 0.0, 15.0));
  ASSERT_FALSE(of_y.empty());
  for (const SurfaceTip& tip : of_y) EXPECT_GT(tip.neck, 0.4);
}

TEST(SurfaceTips, OpenEndsAreNone) {
  const TriMesh open = geometry::surface_of(geometry::y_junction(20.0, 15.0, 2.0, 1.5, 60.0), 0.4, true);
  EXPECT_TRUE(find_tips(open, Vec3(0.0, 0.0, -20.0)).empty());
}

TEST(SurfaceTips, ARingHasTwoAtMost) {
  // Going round a ring there is one farthest place, which is no end; it stands out all the same.
  EXPECT_LE(find_tips(closed(geometry::torus(12.0, 2.0))).size(), 2u);
}

TEST(SurfaceTips, RefusesWhatItCannotTell) {
  EXPECT_THROW(find_tips(TriMesh{}), InvalidInput);
  const TriMesh one = closed(geometry::straight_tube(10.0, 2.0));
  TriMesh other = one;
  for (Vec3& p : other.points) p.x() += 50.0;
  EXPECT_THROW(find_tips(geometry::merged(one, other)), InvalidInput);
  TipOptions options;
  options.least_length_radii = 1.0;
  EXPECT_THROW(find_tips(one, std::nullopt, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::centerline
