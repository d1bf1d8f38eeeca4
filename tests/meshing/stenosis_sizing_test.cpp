#include "ostia/meshing/stenosis_sizing.h"

#include "shape_tree.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

TEST(Throats, AStenosisOfKnownSizeIsFoundWhereItIs) {
  for (const double severity : {0.4, 0.6, 0.9}) {
    const auto found = find_throats(tree_of(geometry::stenosed_tube(60.0, 1.5, severity, 30.0, 8.0)));
    ASSERT_EQ(found.size(), 1U) << severity;
    EXPECT_NEAR((found[0].place - Vec3(0.0, 0.0, 30.0)).norm(), 0.0, 0.11);
    EXPECT_NEAR(found[0].radius_mm, 1.5 * (1.0 - severity), 0.01);
    EXPECT_NEAR(found[0].narrowing, severity, 0.01);
    EXPECT_NEAR(found[0].length_mm, 4.0, 0.25);  // half of a cosine's depth over half of its length
  }
  EXPECT_TRUE(find_throats(tree_of(geometry::stenosed_tube(60.0, 1.5, 0.25, 30.0, 8.0))).empty());
}

TEST(Throats, WhatTapersOrBranchesIsNone) {
  EXPECT_TRUE(find_throats(tree_of(geometry::tapered_tube(60.0, 2.0, 0.5))).empty());
  EXPECT_TRUE(find_throats(tree_of(geometry::y_junction(15.0, 15.0, 2.0, 1.0, 60.0))).empty());
  EXPECT_TRUE(find_throats(tree_of(geometry::coronary_like_tree())).empty());
}

TEST(Throats, OneOfTheWayThatVesselsShareIsFoundOnce) {
  geometry::AnalyticShape shape = geometry::y_junction(30.0, 30.0, 2.0, 1.4, 60.0);
  for (geometry::AnalyticTube& tube : shape.tubes)
    for (std::size_t i = 0; i < tube.axis.size(); ++i) {
      const double from_throat = std::abs(tube.axis.points[i].z() + 15.0);
      if (from_throat < 3.0) tube.axis.radius[i] *= 1.0 - 0.25 * (1.0 + std::cos(M_PI * from_throat / 3.0));
    }
  const geometry::VesselTree tree = tree_of(shape);
  ASSERT_GE(tree.vessels.size(), 2U);
  const auto found = find_throats(tree);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].narrowing, 0.5, 0.01);
  EXPECT_NEAR(found[0].place.z(), -15.0, 0.11);
}

TEST(Throats, TwoInARowAreTwo) {
  geometry::AnalyticShape shape = geometry::straight_tube(80.0, 1.5);
  geometry::Centerline& axis = shape.tubes[0].axis;
  for (std::size_t i = 0; i < axis.size(); ++i)
    for (const double centre : {25.0, 50.0}) {
      const double from_throat = std::abs(axis.abscissa[i] - centre);
      if (from_throat < 4.0) axis.radius[i] *= 1.0 - 0.25 * (1.0 + std::cos(M_PI * from_throat / 4.0));
    }
  const auto found = find_throats(tree_of(shape));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].place.z(), 25.0, 0.11);
  EXPECT_NEAR(found[1].place.z(), 50.0, 0.11);
}

TEST(Throats, TheirFociReachOverTheNarrowingAndADiameterBeyond) {
  const auto foci = size_foci({{1, Vec3(0, 0, 30), 0.6, 0.6, 4.0}}, 0.5, 1.0);
  ASSERT_EQ(foci.size(), 1U);
  EXPECT_NEAR(foci[0].reach_mm, 2.0 + 3.0 * 1.5, 1e-9);  // 3 mm of healthy diameter
  EXPECT_EQ(foci[0].share, 0.5);
  EXPECT_THROW(size_foci({}, 0.0), InvalidInput);
  EXPECT_THROW(size_foci({}, 0.5, -1.0), InvalidInput);
}

TEST(Throats, AreFoundByTheWallWhateverTheAxesSayOfIt) {
  const auto shape = geometry::stenosed_tube(40.0, 1.5, 0.6, 20.0, 8.0);
  geometry::VesselTree axes = tree_of(shape);
  for (double& radius : axes.segments[0].axis.radius) radius = 1.5;
  const geometry::TriMesh wall = geometry::structured_surface(shape.tubes[0], 24, 0.3);
  SizingOptions sizing;
  EXPECT_TRUE(at_throats(sizing, axes, wall).foci.empty());
  sizing.throat_share = 0.4;
  const auto foci = at_throats(sizing, axes, wall).foci;
  ASSERT_EQ(foci.size(), 1U);
  EXPECT_NEAR(foci[0].place.z(), 20.0, 0.3);
  EXPECT_EQ(foci[0].share, 0.4);
  sizing.throat_share = 0.0;
  EXPECT_THROW(validate(sizing), InvalidInput);
}

TEST(Throats, RefuseBadOptions) {
  const geometry::VesselTree tree = tree_of(geometry::straight_tube(20.0, 1.0));
  EXPECT_THROW(find_throats(tree, {.least_narrowing = 0.0}), InvalidInput);
  EXPECT_THROW(find_throats(tree, {.window_diameters = 0.5}), InvalidInput);
}

}  // namespace
}  // namespace ostia::meshing
