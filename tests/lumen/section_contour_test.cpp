#include "edited_walls.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::lumen {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const WallRadius oval_wall = [](double, double theta) {
  return 1.3 * 1.7 / std::hypot(1.3 * std::cos(theta - 0.5), 1.7 * std::sin(theta - 0.5));
};

TEST(SectionContour, TheWallPassesThroughTheContourDrawnInEitherSense) {
  const LumenModel model = bent_model(24.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  SectionContour contour = contour_around(axis, oval_wall, 11.2, 10);
  for (const bool reversed : {false, true}) {
    if (reversed) std::reverse(contour.points.begin(), contour.points.end());
    const EditOutcome outcome = apply(model, contour);
    EXPECT_FALSE(find_fault(outcome.model));
    const ImplicitSurface field = solve(*outcome.model.vessels[0]);
    for (const Vec3& point : contour.points) EXPECT_NEAR(field.value(point), 0.0, 1e-6);
    for (int k = 0; k < 24; ++k) {
      const double theta = 2.0 * pi * k / 24.0;
      EXPECT_NEAR(radius_on_ray(field, axis, 11.2, theta), oval_wall(0.0, theta), 0.03) << theta;
      EXPECT_NEAR(radius_on_ray(field, axis, 7.5, theta), 2.0, 0.03);
      EXPECT_NEAR(radius_on_ray(field, axis, 15.0, theta), 2.0, 0.03);
    }
    for (const SurfaceSample& sample : outcome.changes.at(0).added) {
      EXPECT_GT(sample.normal.dot(sample.position - axis.point(11.2)), 0.5);
      EXPECT_DOUBLE_EQ(sample.s_mm, 11.2);
    }
  }
}

TEST(SectionContour, TakesWhatLiesWithinHalfOfEpsilon) {
  const LumenModel model = bent_model(24.0, 2.0);
  for (const double eps : {0.7, 1.5, 4.0}) {
    SectionContour contour = contour_around(
        axis_of(model), [](double, double) { return 1.4; }, 11.2, 9);
    contour.eps_mm = eps;
    const EditOutcome outcome = apply(model, contour);
    std::vector<std::int64_t> expected;
    for (const SurfaceSample& sample : model.vessels[0]->samples)
      if (std::abs(sample.s_mm - 11.2) < 0.5 * eps) expected.push_back(sample.id);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(outcome.changes.at(0).removed, expected) << eps;
    EXPECT_NO_THROW(solve(*outcome.model.vessels[0])) << eps;
  }
}

TEST(SectionContour, APartialOneTakesItsAnglesAlone) {
  const LumenModel model = straight_model(20.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  SectionContour contour;
  contour.vessel = main_vessel;
  contour.s_mm = 10.0;
  contour.closed = false;
  for (int i = 0; i <= 6; ++i)
    contour.points.push_back(axis.place(10.0, 2.4 + 0.25 * i, 1.5));  // over 180 degrees
  const EditOutcome outcome = apply(model, contour);
  ASSERT_FALSE(outcome.changes.at(0).removed.empty());
  for (const SurfaceSample& sample : model.vessels[0]->samples) {
    const bool gone =
        std::binary_search(outcome.changes[0].removed.begin(), outcome.changes[0].removed.end(), sample.id);
    double theta = geometry::angle_of(axis.frame(sample.s_mm), sample.position - axis.point(sample.s_mm));
    if (theta < 0.0) theta += 2.0 * pi;
    const bool near = std::abs(sample.s_mm - 10.0) < 0.75;
    if (near && theta > 2.4 && theta < 3.9) {
      EXPECT_TRUE(gone) << theta;
    } else if (!near || theta < 1.9 || theta > 4.4) {
      EXPECT_FALSE(gone) << theta;
    }
  }
  const ImplicitSurface field = solve(*outcome.model.vessels[0]);
  for (int i = 1; i < 6; ++i) EXPECT_NEAR(radius_on_ray(field, axis, 10.0, 2.4 + 0.25 * i), 1.5, 0.03);
  for (const double theta : {-0.8, 0.0, 0.8}) EXPECT_NEAR(radius_on_ray(field, axis, 10.0, theta), 2.0, 0.03);
}

TEST(SectionContour, NormalsLeanWithTheWallAlongTheVessel) {
  // A cone: its wall grows by 0.1 mm a mm.
  const LumenModel model =
      model_of_walls(straight_model(20.0, 2.0).tree, {[](double s, double) { return 1.0 + 0.1 * s; }});
  const AxisCurve& axis = axis_of(model);
  const EditOutcome outcome =
      apply(model, contour_around(
                       axis, [](double s, double) { return 1.0 + 0.1 * s; }, 10.0, 12));
  for (const SurfaceSample& sample : outcome.changes.at(0).added)
    EXPECT_NEAR(sample.normal.dot(axis.frame(10.0).tangent), -std::sin(std::atan(0.1)), 0.01);
}

TEST(SectionContour, TwiceIsOnceAndTheLaterWins) {
  const LumenModel model = bent_model(20.0, 2.0);
  const AxisCurve& axis = axis_of(model);
  const SectionContour contour = contour_around(axis, oval_wall, 9.0, 11);
  const LumenModel once = apply(model, contour).model, twice = apply(once, contour).model;
  EXPECT_LT(difference(geometry_of(*once.vessels[0]), geometry_of(*twice.vessels[0])), 1e-9);
  const SectionContour round = contour_around(
      axis, [](double, double) { return 1.5; }, 9.0, 11);
  const ImplicitSurface field = solve(*apply(once, round).model.vessels[0]);
  for (int k = 0; k < 12; ++k) EXPECT_NEAR(radius_on_ray(field, axis, 9.0, 0.5 * k), 1.5, 0.01);
}

TEST(SectionContour, BelongsToTheVesselWhoseWallItIs) {
  const LumenModel model = forked_model();
  SectionContour contour = contour_around(
      axis_of(model), [](double, double) { return 1.5; }, 6.0, 9);
  contour.vessel = side_vessel;
  const EditOutcome outcome = apply(model, contour);
  ASSERT_EQ(outcome.changes.size(), 1U);
  EXPECT_EQ(outcome.changes[0].vessel, main_vessel);
  EXPECT_EQ(outcome.model.vessels[1], model.vessels[1]);
}

TEST(SectionContour, RefusesWhatIsNoSection) {
  const LumenModel model = straight_model(20.0, 2.0);
  const std::string before = digest(model);
  SectionContour contour;
  contour.vessel = main_vessel;
  contour.s_mm = 10.0;
  const auto says = [&](std::vector<Vec3> points) {
    contour.points = std::move(points);
    return refusal(model, contour);
  };
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {0.0, 1.0, 10.0}}), HasSubstr("at least 3"));
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {0.0, 1.0, 10.0}, {1.0, 0.0, 10.0}}), HasSubstr("at least 3"));
  EXPECT_THAT(says({{-1.0, 1.0, 10.0}, {0.0, 1.0, 10.0}, {1.0, 1.0, 10.0}}), HasSubstr("no area"));
  EXPECT_THAT(says({{1.0, 1.0, 10.0}, {2.0, 1.0, 10.0}, {1.5, 2.0, 10.0}}), HasSubstr("around the axis"));
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {-1.0, 0.1, 10.0}, {1.0, 1.0, 10.0}, {0.0, -1.0, 10.0}}),
              HasSubstr("crosses itself"));
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {0.0, 1.0, 12.0}, {-1.0, -1.0, 10.0}}), HasSubstr("off the section"));
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {0.0, std::nan(""), 10.0}, {-1.0, -1.0, 10.0}}),
              HasSubstr("not finite"));
  EXPECT_THAT(says({{19.0, 0.0, 10.0}, {0.0, 1.0, 10.0}, {-1.0, -1.0, 10.0}}),
              HasSubstr("choose the vessel"));
  contour.s_mm = 30.0;
  EXPECT_THAT(says({{1.0, 0.0, 30.0}, {0.0, 1.0, 30.0}, {-1.0, -1.0, 30.0}}), HasSubstr("not on the vessel"));
  contour.s_mm = 10.0;
  contour.eps_mm = 0.0;
  EXPECT_THAT(says({{1.0, 0.0, 10.0}, {0.0, 1.0, 10.0}, {-1.0, -1.0, 10.0}}), HasSubstr("eps"));
  EXPECT_EQ(digest(model), before);
}

}  // namespace
}  // namespace ostia::lumen
