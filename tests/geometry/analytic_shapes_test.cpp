#include "ostia/geometry/analytic_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;

void expect_sound(const AnalyticShape& shape) {
  for (const AnalyticTube& tube : shape.tubes) {
    const Centerline& axis = tube.axis;
    ASSERT_GE(axis.size(), 3u);
    ASSERT_EQ(axis.radius.size(), axis.size());
    ASSERT_EQ(axis.abscissa.size(), axis.size());
    ASSERT_EQ(axis.frames.size(), axis.size());
    for (std::size_t i = 0; i < axis.size(); ++i) {
      ASSERT_GT(axis.radius[i], 0.0);
      ASSERT_NEAR(axis.frames[i].tangent.norm(), 1.0, 1e-12);
      ASSERT_NEAR(axis.frames[i].normal.dot(axis.frames[i].tangent), 0.0, 1e-12);
      const Vec3 reach = Vec3::Constant(axis.radius[i] + 1.999);
      ASSERT_TRUE(shape.box.contains(axis.points[i] - reach) && shape.box.contains(axis.points[i] + reach));
    }
    const std::vector<double> chords = abscissas(axis.points);
    for (std::size_t i = 0; i < axis.size(); ++i)
      ASSERT_NEAR(axis.abscissa[i], chords[i], 1e-4 * (1.0 + chords[i]));
  }
}

TEST(AnalyticShapes, StraightAndTaperedTubes) {
  const AnalyticShape shape = tapered_tube(20.0, 2.0, 1.0, 0.1);
  expect_sound(shape);
  const Centerline& axis = shape.tubes[0].axis;
  ASSERT_EQ(axis.size(), 201u);
  for (std::size_t i = 0; i < axis.size(); ++i) {
    EXPECT_NEAR(axis.points[i].z(), 0.1 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(axis.radius[i], 2.0 - axis.abscissa[i] / 20.0, 1e-12);
  }
  EXPECT_EQ(straight_tube(5.0, 1.5).tubes[0].axis.radius.back(), 1.5);
}

TEST(AnalyticShapes, HelixHasItsLengthCurvatureAndPlaces) {
  const AnalyticShape shape = helix_tube(10.0, 15.0, 2.0, 1.0, 0.05);
  expect_sound(shape);
  const Centerline& axis = shape.tubes[0].axis;
  EXPECT_NEAR(axis.abscissa.back(), 2.0 * std::hypot(2.0 * pi * 10.0, 15.0), 1e-9);
  EXPECT_NEAR(axis.points.back().z(), 30.0, 1e-9);
  for (const Vec3& p : axis.points) {
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 10.0, 1e-12);
    const double angle = 2.0 * pi * p.z() / 15.0;
    EXPECT_LT((p.head<2>() - 10.0 * Vec2(std::cos(angle), std::sin(angle))).norm(), 1e-9);
  }
}

TEST(AnalyticShapes, TorusAxisIsAClosedCircle) {
  const AnalyticShape shape = torus(8.0, 2.0);
  expect_sound(shape);
  const Centerline& axis = shape.tubes[0].axis;
  EXPECT_EQ(axis.points.front(), axis.points.back());
  EXPECT_NEAR(axis.abscissa.back(), 16.0 * pi, 1e-9);
  for (const Vec3& p : axis.points) EXPECT_NEAR(p.norm(), 8.0, 1e-12);
}

TEST(AnalyticShapes, StenosisNarrowsByItsSeverity) {
  const AnalyticShape shape = stenosed_tube(30.0, 1.5, 0.6, 15.0, 8.0);
  expect_sound(shape);
  const Centerline& axis = shape.tubes[0].axis;
  EXPECT_NEAR(axis.radius[150], 1.5 * 0.4, 1e-12);
  EXPECT_NEAR(axis.radius[130], 1.5 * (1.0 - 0.3), 1e-12);  // a quarter of the length away: half as deep
  EXPECT_EQ(axis.radius[100], 1.5);
  EXPECT_EQ(axis.radius[200], 1.5);
}

TEST(AnalyticShapes, YJunctionSplitsAtTheOriginByItsAngle) {
  const AnalyticShape shape = y_junction(10.0, 15.0, 1.5, 1.1, 60.0);
  expect_sound(shape);
  ASSERT_EQ(shape.tubes.size(), 3u);
  EXPECT_LT(shape.tubes[0].axis.points.back().norm(), 1e-12);
  EXPECT_LT((shape.tubes[0].axis.points.front() - Vec3(0, 0, -10)).norm(), 1e-12);
  for (std::size_t child = 1; child < 3; ++child) {
    const Centerline& axis = shape.tubes[child].axis;
    EXPECT_LT(axis.points.front().norm(), 1e-12);
    EXPECT_LT((axis.frames.front().tangent - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(axis.abscissa.back(), 15.0, 1e-9);
    for (const Vec3& p : axis.points) EXPECT_NEAR(p.y(), 0.0, 1e-12);
  }
  const Vec3 a = shape.tubes[1].axis.frames.back().tangent, b = shape.tubes[2].axis.frames.back().tangent;
  EXPECT_NEAR(std::acos(a.dot(b)) * 180.0 / pi, 60.0, 1e-9);
}

// The coronary-like tree.

TEST(CoronaryLikeTree, HasTheSizeOfACoronaryTree) {
  const AnalyticShape tree = coronary_like_tree();
  expect_sound(tree);
  ASSERT_EQ(tree.tubes.size(), 4u);
  EXPECT_EQ(tree.tubes[0].axis.radius.front(), 2.0);
  double sum = 0.0;
  for (const AnalyticTube& tube : tree.tubes) {
    sum += tube.axis.abscissa.back();
    EXPECT_NEAR(tube.axis.radius.back(), 0.8, 1e-12);
    for (std::size_t i = 1; i < tube.axis.size(); ++i)
      EXPECT_LT(tube.axis.radius[i], tube.axis.radius[i - 1]);
  }
  EXPECT_GT(sum, 120.0);
  EXPECT_LT(sum, 250.0);
}

TEST(CoronaryLikeTree, IsGentlyCurved) {
  const AnalyticShape tree = coronary_like_tree();
  for (const AnalyticTube& tube : tree.tubes) {
    const Centerline& axis = tube.axis;
    for (std::size_t i = 1; i < axis.size(); ++i) {
      const Vec3 turn = axis.frames[i].tangent - axis.frames[i - 1].tangent;
      EXPECT_LE(turn.norm() / (axis.abscissa[i] - axis.abscissa[i - 1]), 1.0 / 15.0 + 1e-6) << tube.name;
    }
  }
}

TEST(CoronaryLikeTree, BranchesStartOnTheAxisAlongItAndTurnAway) {
  const AnalyticShape tree = coronary_like_tree();
  const Centerline& main = tree.tubes[0].axis;
  for (std::size_t b = 1; b < 4; ++b) {
    const Centerline& branch = tree.tubes[b].axis;
    const PolylineLocation start = closest(main.points, branch.points.front());
    EXPECT_LT((start.point - branch.points.front()).norm(), 1e-4);
    EXPECT_GT(main.frames[start.segment].tangent.dot(branch.frames.front().tangent), 1.0 - 1e-4);
    EXPECT_LT(branch.radius.front(), main.radius[start.segment]);
    // The first bend is over where the direction from the start turns no more in its plane: 40 to 70 degrees.
    double angle = 0.0;
    for (std::size_t i = 0; i < branch.size() && branch.abscissa[i] < 18.0; ++i) {
      const double cosine = branch.frames[i].tangent.dot(branch.frames.front().tangent);
      angle = std::max(angle, std::acos(std::min(1.0, cosine)) * 180.0 / pi);
    }
    EXPECT_GT(angle, 40.0) << tree.tubes[b].name;
    EXPECT_LT(angle, 70.0) << tree.tubes[b].name;
  }
}

TEST(CoronaryLikeTree, TubesMeetOnlyAtTheirBifurcations) {
  const AnalyticShape tree = coronary_like_tree();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (i == j) continue;
      AnalyticShape other;
      other.tubes = {tree.tubes[j]};
      const TubeDistance f(other);
      const Centerline& axis = tree.tubes[i].axis;
      int stretches = 0;  // of the axis where the two tubes overlap
      bool within = false;
      for (std::size_t k = 0; k < axis.size(); ++k) {
        const double gap = f(axis.points[k]) - axis.radius[k];
        if (gap < 0.0 && !within) ++stretches;
        within = gap < 0.0;
        if (i != 0 && j != 0) {
          EXPECT_GT(gap, 2.0) << tree.tubes[i].name << " and " << tree.tubes[j].name;
        }
        if (i != 0 && j == 0 && axis.abscissa[k] > 14.0) {
          EXPECT_GT(gap, 1.5) << tree.tubes[i].name;
        }
      }
      EXPECT_EQ(stretches, i == 0 || j == 0 ? 1 : 0);
    }
  }
}

TEST(AnalyticShapes, RefuseSenselessSizes) {
  EXPECT_THROW(straight_tube(0.0, 1.0), InvalidInput);
  EXPECT_THROW(straight_tube(5.0, -1.0), InvalidInput);
  EXPECT_THROW(straight_tube(5.0, 1.0, 0.0), InvalidInput);
  EXPECT_THROW(helix_tube(10, 5, 0, 1), InvalidInput);
  EXPECT_THROW(torus(2, 3), InvalidInput);
  EXPECT_THROW(stenosed_tube(20, 1, 1.0, 10, 5), InvalidInput);
  EXPECT_THROW(stenosed_tube(20, 1, 0.5, 10, 0), InvalidInput);
  EXPECT_THROW(y_junction(10, 10, 1, 1, 180), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
