#include "edited_walls.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::lumen {
namespace {

using namespace testing;
using ::testing::HasSubstr;

WallDrag drag_at(const AxisCurve& axis, double s, double theta, double from_mm, double to_mm,
                 double reach_mm) {
  WallDrag drag;
  drag.vessel = main_vessel;
  drag.from = axis.place(s, theta, from_mm);
  drag.to = axis.place(s, theta, to_mm);
  drag.reach_mm = reach_mm;
  return drag;
}

TEST(WallDrag, TheWallPassesThroughTheTargetAndFollowsLessWithDistance) {
  const LumenModel model = bent_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  for (const double target : {1.4, 2.7}) {
    const WallDrag drag = drag_at(axis, 11.3, 0.7, 2.0, target, 3.0);
    const EditOutcome outcome = apply(model, drag);
    EXPECT_FALSE(find_fault(outcome.model));
    const ImplicitSurface field = solve(*outcome.model.vessels[0]);
    EXPECT_NEAR(field.value(drag.to), 0.0, 1e-6);
    double last = std::abs(target - 2.0) + 1e-6;
    for (const double away : {0.0, 0.8, 1.6, 2.4, 3.2}) {
      const double moved = std::abs(radius_on_ray(field, axis, 11.3 + away, 0.7) - 2.0);
      EXPECT_LT(moved, last + 0.01) << away;
      last = moved;
    }
    EXPECT_LT(last, 0.03);
    EXPECT_NEAR(radius_on_ray(field, axis, 11.3 + 1.5, 0.7), 2.0 + (target - 2.0) * 0.5625, 0.08);
    for (double s = 2.0; s < 22.0; s += 2.0) EXPECT_NEAR(radius_on_ray(field, axis, s, 0.7 + pi), 2.0, 0.02);
  }
}

TEST(WallDrag, TakesHoldOfTheWallWhereItHasNoSample) {
  const LumenModel model = straight_model(20.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  for (const double s : {9.0, 9.37, 9.8})
    for (const double theta : {0.0, 0.21, 0.4}) {
      const WallDrag drag = drag_at(axis, s, theta, 2.0, 1.7, 2.0);
      const ImplicitSurface field = solve(*apply(model, drag).model.vessels[0]);
      EXPECT_NEAR(radius_on_ray(field, axis, s, theta), 1.7, 1e-5);
    }
}

TEST(WallDrag, NothingBeyondTheReachMoves) {
  const LumenModel model = bent_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const WallDrag drag = drag_at(axis, 12.0, -2.0, 2.0, 1.5, 2.5);
  const EditOutcome outcome = apply(model, drag);
  for (const SurfaceSample& sample : model.vessels[0]->samples) {
    const bool gone = std::binary_search(outcome.changes.at(0).removed.begin(),
                                         outcome.changes[0].removed.end(), sample.id);
    EXPECT_FALSE(gone && (sample.position - drag.from).norm() > 2.5);
  }
  for (const SurfaceSample& sample : outcome.changes[0].added) {
    EXPECT_LT((sample.position - drag.from).norm(), 2.6);
    EXPECT_NEAR(sample.normal.norm(), 1.0, 1e-12);
  }
  EXPECT_LE(outcome.changes[0].added.size(), outcome.changes[0].removed.size() + 1);
}

TEST(WallDrag, OtherBranchesStay) {
  const LumenModel model = forked_model();
  const AxisCurve& side = axis_of(model, side_vessel);
  WallDrag drag = drag_at(side, 20.0, 0.5, 1.2, 0.8, 3.0);
  drag.vessel = side_vessel;
  const EditOutcome outcome = apply(model, drag);
  ASSERT_EQ(outcome.changes.size(), 1U);
  EXPECT_EQ(outcome.changes[0].vessel, side_vessel);
  EXPECT_EQ(outcome.model.vessels[0], model.vessels[0]);
  // On the stretch that both share it is the main vessel's wall.
  drag = drag_at(axis_of(model), 5.0, 2.0, 1.8, 1.5, 3.0);
  drag.vessel = side_vessel;
  EXPECT_EQ(apply(model, drag).changes.at(0).vessel, main_vessel);
}

TEST(WallDrag, HairpinLimbsDoNotPullEachOther) {
  const LumenModel model = hairpin_model(15.0, 2.6, 2.0);  // limbs 1.2 mm apart
  const AxisCurve& axis = axis_of(model);
  const double theta = geometry::angle_of(axis.frame(5.0), Vec3::UnitX());
  const EditOutcome outcome = apply(model, drag_at(axis, 5.0, theta, 2.0, 1.6, 3.0));
  for (const SurfaceSample& sample : outcome.changes.at(0).added) EXPECT_LT(sample.s_mm, 12.0);
}

TEST(WallDrag, Refusals) {
  const LumenModel model = straight_model(20.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const std::string before = digest(model);
  EXPECT_THAT(refusal(model, drag_at(axis, 10.0, 0.0, 9.0, 8.0, 3.0)), HasSubstr("take hold of the wall"));
  EXPECT_THAT(refusal(model, drag_at(axis, 10.0, 0.0, 2.0, 0.02, 3.0)), HasSubstr("from the axis"));
  EXPECT_THAT(refusal(model, drag_at(axis, 10.0, 0.0, 2.0, -1.5, 3.0)), HasSubstr("wall.drag on LAD"));
  EXPECT_THAT(refusal(model, drag_at(axis, 10.0, 0.0, 2.0, 1.5, 0.0)), HasSubstr("reach"));
  WallDrag along = drag_at(axis, 10.0, 0.0, 2.0, 2.0, 1.5);
  along.to.z() += 1.5;
  EXPECT_THAT(refusal(model, along), HasSubstr("larger reach"));
  EXPECT_EQ(digest(model), before);
  const EditOutcome nothing = apply(model, drag_at(axis, 10.0, 0.0, 2.0, 2.0, 3.0));
  EXPECT_TRUE(nothing.changes.empty());
  EXPECT_EQ(nothing.notes.size(), 1U);
}

}  // namespace
}  // namespace ostia::lumen
