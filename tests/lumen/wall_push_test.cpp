#include "edited_walls.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::lumen {
namespace {

using namespace testing;
using ::testing::HasSubstr;

WallPush push_along(std::vector<Vec3> path, double radius_mm) {
  WallPush push;
  push.vessel = main_vessel;
  push.path = std::move(path);
  push.radius_mm = radius_mm;
  return push;
}

TEST(WallPush, FromWithinTheWallGivesWayToTheBall) {
  const LumenModel model = straight_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const double theta = 0.6;
  std::vector<Vec3> path;
  for (double rho = 0.0; rho <= 1.4; rho += 0.2) path.push_back(axis.place(12.0, theta, rho));
  path.push_back(axis.place(14.0, theta, 1.4));
  const EditOutcome outcome = apply(model, push_along(path, 1.2));
  EXPECT_FALSE(find_fault(outcome.model));
  const ImplicitSurface field = solve(*outcome.model.vessels[0]);
  for (const double s : {12.0, 12.7, 13.5, 14.0})
    EXPECT_NEAR(radius_on_ray(field, axis, s, theta), 2.6, 0.06) << s;
  // Nothing of the ball's way is left outside, and the other side stays.
  for (const Vec3& centre : path)
    for (double a = 0.0; a < 6.0; a += 0.5)
      EXPECT_LT(field.value(centre + 0.9 * 1.2 * Vec3(std::cos(a), std::sin(a), 0.0)), 0.06);
  for (double s = 4.0; s < 22.0; s += 2.0) EXPECT_NEAR(radius_on_ray(field, axis, s, theta + pi), 2.0, 0.03);
  EXPECT_NEAR(radius_on_ray(field, axis, 8.0, theta), 2.0, 0.03);
}

TEST(WallPush, FromWithoutItIsPressedIn) {
  const LumenModel model = bent_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const EditOutcome outcome =
      apply(model, push_along({axis.place(12.0, 0.0, 4.0), axis.place(12.0, 0.0, 2.9)}, 1.5));
  const ImplicitSurface field = solve(*outcome.model.vessels[0]);
  EXPECT_NEAR(radius_on_ray(field, axis, 12.0, 0.0), 1.4, 0.05);
  EXPECT_NEAR(radius_on_ray(field, axis, 12.0, pi), 2.0, 0.03);
  EXPECT_TRUE(outcome.notes.empty());
}

TEST(WallPush, ASmallBallFindsTheWallBetweenSamples) {
  const LumenModel model = straight_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  for (const double s : {11.1, 11.5, 12.2}) {
    const EditOutcome outcome =
        apply(model, push_along({axis.place(s, 0.13, 1.2), axis.place(s, 0.13, 1.9)}, 0.45));
    ASSERT_EQ(outcome.changes.size(), 1U) << s;
    const ImplicitSurface field = solve(*outcome.model.vessels[0]);
    EXPECT_NEAR(radius_on_ray(field, axis, s, 0.13), 2.35, 0.12) << s;
  }
}

TEST(WallPush, NeverPassesTheAxis) {
  const LumenModel model = straight_model(24.0, 1.5);
  const AxisCurve& axis = axis_of(model);
  const EditOutcome outcome =
      apply(model, push_along({axis.place(12.0, 0.0, 4.0), axis.place(12.0, 0.0, 0.5)}, 1.5));
  ASSERT_EQ(outcome.notes.size(), 1U);
  EXPECT_THAT(outcome.notes[0], HasSubstr("never passes its axis"));
  for (const SurfaceSample& sample : outcome.model.vessels[0]->samples)
    EXPECT_TRUE(sample.origin == SampleOrigin::cap ||
                (sample.position - axis.point(sample.s_mm)).norm() > 0.19);
  // The far wall is not pulled along.
  const ImplicitSurface field = solve(*outcome.model.vessels[0]);
  for (const double turn : {-0.5, 0.0, 0.5})
    for (const double s : {4.0, 20.0}) EXPECT_NEAR(radius_on_ray(field, axis, s, pi + turn), 1.5, 0.02);
  for (const SurfaceSample& sample : outcome.changes.at(0).added)
    EXPECT_LT(
        std::abs(geometry::angle_of(axis.frame(sample.s_mm), sample.position - axis.point(sample.s_mm))),
        2.0);
}

TEST(WallPush, ABallThatTouchesNothingChangesNothing) {
  const LumenModel model = straight_model(24.0, 2.0);
  const EditOutcome outcome = apply(model, push_along({axis_of(model).point(12.0)}, 1.0));
  EXPECT_TRUE(outcome.changes.empty());
  EXPECT_EQ(digest(outcome.model), digest(model));
  EXPECT_EQ(outcome.notes.size(), 1U);
}

TEST(WallPush, OtherBranchesStay) {
  const LumenModel model = forked_model();
  const AxisCurve& axis = axis_of(model);
  const EditOutcome outcome =
      apply(model, push_along({axis.place(22.0, pi, 0.2), axis.place(22.0, pi, 1.0)}, 1.2));
  ASSERT_EQ(outcome.changes.size(), 1U);
  EXPECT_EQ(outcome.changes[0].vessel, main_vessel);
  EXPECT_EQ(outcome.model.vessels[1], model.vessels[1]);
}

TEST(WallPush, Refusals) {
  const LumenModel model = straight_model(24.0, 2.0);
  EXPECT_THAT(refusal(model, push_along({}, 1.0)), HasSubstr("at least 1"));
  EXPECT_THAT(refusal(model, push_along({{0.0, 0.0, 12.0}}, 0.0)), HasSubstr("radius"));
  EXPECT_THAT(refusal(model, push_along({{0.0, 0.0, 12.0}}, 11.0)), HasSubstr("radius"));
  EXPECT_THAT(refusal(model, push_along({{40.0, 0.0, 12.0}}, 1.0)), HasSubstr("choose the vessel"));
}

}  // namespace
}  // namespace ostia::lumen
