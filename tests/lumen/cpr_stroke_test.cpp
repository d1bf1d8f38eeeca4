#include "edited_walls.h"
#include "editing/dismissal.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace ostia::lumen {
namespace {

using namespace testing;
using ::testing::HasSubstr;

WallRadius oval(double length_mm) {
  return [=](double s, double theta) {
    const double mean = 1.6 - 0.3 * s / length_mm, a = 1.1 * mean, b = 0.9 * mean;
    return a * b / std::hypot(b * std::cos(theta), a * std::sin(theta));
  };
}

double mean_error(const LumenModel& model, const WallRadius& wall, double from, double to) {
  const ImplicitSurface field = solve(vessel(model, main_vessel));
  double sum = 0.0;
  int count = 0;
  for (double s = from; s <= to; s += 1.0)
    for (int k = 0; k < 24; ++k, ++count) {
      const double theta = 2.0 * pi * k / 24.0;
      sum += std::abs(radius_on_ray(field, axis_of(model), s, theta) - wall(s, theta));
    }
  return sum / count;
}

TEST(CprStroke, TheWallPassesThroughTheStrokeAndTheOtherSideStays) {
  const LumenModel model = bent_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const auto wall = [](double s, double) { return 1.5 + 0.15 * std::sin(0.5 * s); };
  const CprStroke stroke = stroke_along(axis, wall, 0.4, 6.0, 18.0, 9);
  const EditOutcome outcome = apply(model, stroke);
  EXPECT_FALSE(find_fault(outcome.model));
  ASSERT_EQ(outcome.changes.size(), 1U);
  const ImplicitSurface before = solve(vessel(model, main_vessel));
  const ImplicitSurface after = solve(vessel(outcome.model, main_vessel));
  for (const Vec3& point : stroke.points) {
    EXPECT_NEAR(after.value(point), 0.0, 1e-6);
    EXPECT_GT(std::abs(before.value(point)), 0.2);
  }
  // Between its points too, and it is the first that a ray meets.
  for (double s = 7.5; s <= 16.5; s += 0.7)
    EXPECT_NEAR(radius_on_ray(after, axis, s, 0.4), wall(s, 0.4), 0.04) << s;
  for (double s = 2.0; s <= 22.0; s += 1.0)
    for (const double turn : {-0.6, 0.0, 0.6})
      EXPECT_NEAR(radius_on_ray(after, axis, s, 0.4 + pi + turn), 2.0, 0.03) << s;
  for (const double theta : {0.4, 1.2}) {
    EXPECT_NEAR(radius_on_ray(after, axis, 2.0, theta), 2.0, 0.03);
    EXPECT_NEAR(radius_on_ray(after, axis, 22.0, theta), 2.0, 0.03);
  }
}

TEST(CprStroke, TakesWhatTheBundleSaysAndNothingElse) {
  const LumenModel model = bent_model(24.0, 1.9);
  const VesselLumen& tube = vessel(model, main_vessel);
  for (const double beta : {45.0, 60.0, 90.0}) {
    CprStroke stroke = stroke_along(
        *tube.axis, [](double, double) { return 1.3; }, -1.0, 5.0, 17.0, 6);
    stroke.beta_deg = beta;
    const EditOutcome outcome = apply(model, stroke);
    const std::set<std::int64_t> removed(outcome.changes.at(0).removed.begin(),
                                         outcome.changes.at(0).removed.end());
    for (const SurfaceSample& sample : tube.samples) {
      const Vec3 offset = sample.position - tube.axis->point(sample.s_mm);
      const double theta = geometry::angle_of(tube.axis->frame(sample.s_mm), offset);
      const double angle = std::abs(std::remainder(theta + 1.0, 2.0 * pi)) * 180.0 / pi;
      const bool is_cap = sample.origin == SampleOrigin::cap;
      if (is_cap || angle > beta + 1e-6 || sample.s_mm < 4.0 || sample.s_mm > 18.0) {
        EXPECT_FALSE(removed.contains(sample.id)) << sample.s_mm << ' ' << angle;
      } else if (angle < beta - 1e-6 && sample.s_mm > 5.0 && sample.s_mm < 17.0) {
        EXPECT_TRUE(removed.contains(sample.id)) << sample.s_mm << ' ' << angle;
      }
    }
    for (const SurfaceSample& sample : outcome.changes[0].added) EXPECT_GE(sample.id, model.next_sample_id);
  }
}

TEST(CprStroke, DrawnTwiceOrBackwardsGivesTheSameWall) {
  const LumenModel model = bent_model(24.0, 2.0);
  const CprStroke stroke = stroke_along(
      axis_of(model), [](double s, double) { return 1.4 + 0.02 * s; }, 2.2, 4.0, 19.0, 8);
  CprStroke backwards = stroke;
  std::reverse(backwards.points.begin(), backwards.points.end());
  const LumenModel once = apply(model, stroke).model, twice = apply(once, stroke).model;
  EXPECT_LT(difference(geometry_of(*once.vessels[0]), geometry_of(*twice.vessels[0])), 1e-9);
  const LumenModel other = apply(model, backwards).model;
  EXPECT_LT(difference(geometry_of(*once.vessels[0]), geometry_of(*other.vessels[0])), 1e-6);
  EXPECT_EQ(digest(apply(model, stroke).model), digest(once));
}

TEST(CprStroke, TheLaterOfTwoContradictingStrokesWins) {
  const LumenModel model = straight_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const auto drawn = [&](double radius) {
    return stroke_along(
        axis, [=](double, double) { return radius; }, 0.0, 5.0, 19.0, 7);
  };
  const LumenModel last = apply(apply(model, drawn(1.2)).model, drawn(1.6)).model;
  const LumenModel alone = apply(model, drawn(1.6)).model;
  const ImplicitSurface both = solve(*last.vessels[0]), one = solve(*alone.vessels[0]);
  for (double s = 6.0; s < 18.0; s += 1.0) {
    EXPECT_NEAR(radius_on_ray(both, axis, s, 0.0), 1.6, 0.03);
    EXPECT_NEAR(radius_on_ray(both, axis, s, 0.9), radius_on_ray(one, axis, s, 0.9), 0.05);
  }
}

TEST(CprStroke, FourStrokesAndAContourMakeAnOvalTaperedVessel) {
  for (const bool bent : {false, true}) {
    LumenModel model = bent ? bent_model(32.0, 2.0) : straight_model(32.0, 2.0);
    const WallRadius wall = oval(32.0);
    EXPECT_GT(mean_error(model, wall, 2.0, 30.0), 0.4);
    for (const double theta : {0.0, pi, 0.5 * pi, -0.5 * pi})
      model = apply(model, stroke_along(axis_of(model), wall, theta, 0.3, axis_of(model).length() - 0.3, 12))
                  .model;
    model = apply(model, contour_around(axis_of(model), wall, 16.0, 10)).model;
    EXPECT_FALSE(find_fault(model));
    EXPECT_LT(mean_error(model, wall, 2.0, 30.0), 0.03) << bent;
  }
}

TEST(CprStroke, AShakyHandDoesNotMakeTheWallWobble) {
  LumenModel model = straight_model(32.0, 2.0);
  std::mt19937 random(7);
  const auto shake = [&] {
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random()) / 4294967296.0;
    return 0.05 * (sum - 6.0);
  };
  const WallRadius wall = oval(32.0);
  for (const double theta : {0.0, pi, 0.5 * pi, -0.5 * pi}) {
    CprStroke stroke = stroke_along(axis_of(model), wall, theta, 0.3, 31.7, 12);
    for (Vec3& point : stroke.points) point += Vec3(shake(), shake(), shake());
    model = apply(model, stroke).model;
  }
  EXPECT_LT(mean_error(model, wall, 2.0, 30.0), 0.06);
}

TEST(CprStroke, FollowsAHairpinTighterThanTheDrawnPointsAreApart) {
  const LumenModel model = hairpin_model(10.0, 3.5, 2.0);
  const AxisCurve& axis = axis_of(model);
  const auto wall = [](double, double) { return 1.5; };
  for (const double theta : {0.0, 0.5 * pi, pi}) {
    const EditOutcome outcome = apply(model, stroke_along(axis, wall, theta, 4.0, axis.length() - 4.0, 8));
    EXPECT_FALSE(find_fault(outcome.model));
    for (const SurfaceSample& sample : outcome.changes.at(0).added) {
      if (sample.origin != SampleOrigin::edit) continue;
      EXPECT_NEAR((sample.position - axis.place(sample.s_mm, theta, 1.5)).norm(), 0.0, 0.02) << sample.s_mm;
    }
    const ImplicitSurface field = solve(*outcome.model.vessels[0]);
    for (double s = 5.0; s < axis.length() - 5.0; s += 1.0)
      EXPECT_NEAR(radius_on_ray(field, axis, s, theta), 1.5, 0.05) << s << ' ' << theta;
  }
}

TEST(CprStroke, CapsFollowTheWallAtTheEnds) {
  LumenModel model = bent_model(20.0, 2.0);
  const double length = axis_of(model).length();
  const auto wall = [](double, double) { return 1.2; };
  for (const double theta : {0.0, pi, 0.5 * pi, -0.5 * pi})
    model = apply(model, stroke_along(axis_of(model), wall, theta, 10.0, length, 6)).model;
  EXPECT_FALSE(find_fault(model));
  double farthest = 0.0, height = 0.0;
  int caps = 0;
  for (const SurfaceSample& sample : vessel(model, main_vessel).samples) {
    if (sample.origin != SampleOrigin::cap || sample.s_mm < 10.0) continue;
    const Vec3 offset = sample.position - axis_of(model).point(length);
    const Vec3 tangent = axis_of(model).frame(length).tangent;
    height = std::max(height, offset.dot(tangent));
    farthest = std::max(farthest, (offset - offset.dot(tangent) * tangent).norm());
    ++caps;
  }
  EXPECT_GT(caps, 4);
  EXPECT_LT(farthest, 1.25);
  EXPECT_NEAR(height, 1.2, 0.1);
  const ImplicitSurface field = solve(vessel(model, main_vessel));
  for (double theta = 0.0; theta < 6.0; theta += 0.5)
    EXPECT_NEAR(radius_on_ray(field, axis_of(model), length - 0.3, theta), 1.2, 0.05);
  // The other end has kept its cap to the last sample.
  const LumenModel start = bent_model(20.0, 2.0);
  for (const SurfaceSample& sample : vessel(start, main_vessel).samples)
    EXPECT_TRUE(sample.origin != SampleOrigin::cap || sample.s_mm > 10.0 ||
                ids_of(vessel(model, main_vessel).samples).contains(sample.id));
}

TEST(CprStroke, WallOnASharedStretchIsItsOwners) {
  const LumenModel model = forked_model();
  CprStroke stroke = stroke_along(
      axis_of(model, side_vessel), [](double, double) { return 1.3; }, pi, 3.0, 25.0, 12);
  stroke.vessel = side_vessel;
  const EditOutcome outcome = apply(model, stroke);
  EXPECT_FALSE(find_fault(outcome.model));
  ASSERT_EQ(outcome.changes.size(), 2U);
  const double fork = own_from_mm(model.tree, side_vessel);
  for (const VesselChange& change : outcome.changes) {
    const VesselLumen& before = vessel(model, change.vessel);
    for (const SurfaceSample& sample : before.samples) {
      const bool removed = std::binary_search(change.removed.begin(), change.removed.end(), sample.id);
      EXPECT_FALSE(change.vessel == main_vessel && sample.s_mm > fork + 0.6 && removed) << sample.s_mm;
    }
    for (const SurfaceSample& sample : change.added) {
      if (change.vessel == main_vessel) {
        EXPECT_LT(sample.s_mm, fork + 0.1);
      } else {
        EXPECT_GT(sample.s_mm, fork - 0.1);
      }
    }
  }
  // A stroke within the shared stretch leaves the branch's own wall the very same.
  stroke.points.resize(4);
  const EditOutcome shared = apply(model, stroke);
  ASSERT_EQ(shared.changes.size(), 1U);
  EXPECT_EQ(shared.changes[0].vessel, main_vessel);
  EXPECT_EQ(shared.model.vessels[1], model.vessels[1]);
}

TEST(CprStroke, RefusesWhatMakesNoWallAndLeavesTheModel) {
  const LumenModel model = straight_model(20.0, 2.0);
  const std::string before = digest(model);
  CprStroke stroke;
  stroke.vessel = main_vessel;
  const auto says = [&](std::vector<Vec3> points, double beta = 60.0) {
    stroke.points = std::move(points);
    stroke.beta_deg = beta;
    return refusal(model, stroke);
  };
  EXPECT_THAT(says({{1.0, 0.0, 5.0}}), HasSubstr("at least 2"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {std::nan(""), 0.0, 6.0}}), HasSubstr("not finite"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {1.0, 0.0, 9.0}}, 40.0), HasSubstr("from 45 to 90"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {-1.0, 0.0, 9.0}}), HasSubstr("axis"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {0.03, 0.0, 7.0}, {1.0, 0.0, 9.0}}), HasSubstr("axis"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {1.0, 0.0, 5.1}}), HasSubstr("section.contour"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {1.8, 0.0, 9.0}, {1.8, 0.0, 5.0}, {1.0, 0.0, 9.0}}),
              HasSubstr("crosses itself"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {1.2, 0.0, 9.0}, {1.6, 0.0, 7.0}, {1.9, 0.0, 12.0}}),
              HasSubstr("back along"));
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {40.0, 0.0, 9.0}}), HasSubstr("choose the vessel"));
  stroke.vessel = 99;
  EXPECT_THAT(says({{1.0, 0.0, 5.0}, {1.0, 0.0, 9.0}}), HasSubstr("99"));
  EXPECT_EQ(digest(model), before);
}

}  // namespace
}  // namespace ostia::lumen
