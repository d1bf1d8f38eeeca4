#include "ostia/lumen/contour_lines.h"

#include "analytic_fields.h"
#include "tube_samples.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/tree_field.h"
#include "ostia/lumen/views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace ostia::lumen {
namespace {

using testing::area_on_the_left;
using testing::ball;
using testing::flat_view;
using testing::FunctionField;
using testing::longest_step;
using testing::torus;

using std::numbers::pi;

TEST(ContourLines, BallIsACircleToItsTolerance) {
  const FunctionField field(ball({0.3, -0.2, 0.4}, 1.5));
  const double radius = std::sqrt(1.5 * 1.5 - 0.4 * 0.4);
  const auto lines = contour_lines(field, flat_view(256, 256, 0.05), {{134.0, 124.0}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed());
  ASSERT_EQ(lines[0].world.size(), lines[0].picture_px.size());
  for (std::size_t i = 0; i < lines[0].world.size(); ++i) {
    const Vec3& p = lines[0].world[i];
    EXPECT_NEAR(std::hypot(p.x() - 0.3, p.y() + 0.2), radius, 1e-6);
    EXPECT_NEAR((p - flat_view(256, 256, 0.05).world(lines[0].picture_px[i])).norm(), 0.0, 1e-12);
  }
  EXPECT_LT(longest_step(lines[0]), 2.0 * std::sqrt(2.0) + 1e-9);
  EXPECT_NEAR(0.5 * area_on_the_left(lines[0]) * 0.05 * 0.05, pi * radius * radius, 0.0065);
}

TEST(ContourLines, ChordsStayWithinTheirBend) {
  const FunctionField field(ball({0.0, 0.0, 0.0}, 0.4));  // 4 pixels
  const auto lines = contour_lines(field, flat_view(64, 64, 0.1), {{32.0, 32.0}}, {.bend_px = 0.01});
  ASSERT_EQ(lines.size(), 1U);
  const auto& points = lines[0].picture_px;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    EXPECT_LT(4.0 - (0.5 * (points[i] + points[i + 1]) - Vec2(32.0, 32.0)).norm(), 0.0101);
}

TEST(ContourLines, TheLumenLiesToTheLeft) {
  // A ring: its outer line runs counter-clockwise as seen, its inner one clockwise.
  const FunctionField field(torus(2.0, 0.6));
  const auto lines = contour_lines(field, flat_view(128, 128, 0.05), {{104.0, 64.0}});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NEAR(0.5 * area_on_the_left(lines[0]), pi * 52.0 * 52.0, 10.0);
  EXPECT_NEAR(0.5 * area_on_the_left(lines[1]), -pi * 28.0 * 28.0, 10.0);
}

TEST(ContourLines, OpenLinesEndAtTheBorder) {
  const FunctionField field([](const Vec3& p) { return std::abs(p.x() - 0.05 * p.y()) - 1.0; });
  const auto lines = contour_lines(field, flat_view(101, 77, 0.1), {{50.0, 38.0}});
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines) {
    EXPECT_FALSE(line.closed());
    const double first = line.picture_px.front().y(), last = line.picture_px.back().y();
    EXPECT_NEAR(std::min(first, last), 0.0, 1e-12);
    EXPECT_NEAR(std::max(first, last), 77.0, 1e-12);
    // The lumen is on the left: up along its right wall, down along its left one.
    EXPECT_EQ(line.picture_px.front().x() < 50.0, first < last);
    EXPECT_LT(longest_step(line), 2.9);
  }
}

TEST(ContourLines, OnlyWhatSeedsReachIsFollowed) {
  const FunctionField field([](const Vec3& p) {
    return std::min(ball({-2.0, 0.0, 0.0}, 0.8)(p), ball({2.0, 1.0, 0.0}, 0.5)(p));
  });
  const ViewSurface view = flat_view(120, 120, 0.1);
  EXPECT_EQ(contour_lines(field, view, {{40.0, 60.0}}).size(), 1U);
  EXPECT_EQ(contour_lines(field, view, {{40.0, 60.0}, {80.0, 70.0}}).size(), 2U);
  // A seed outside is followed to the walls beside, above and below it.
  const auto found = contour_lines(field, view, {{80.0, 100.0}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].world[0].x(), 2.0, 0.6);
  EXPECT_TRUE(contour_lines(field, view, {{5.0, 5.0}}).empty());
}

TEST(ContourLines, SeveralWallsInOneRow) {
  // Seen along its plane a torus has two discs; a wavy band crosses some rows four times.
  const FunctionField field(
      [](const Vec3& p) { return (std::abs(p.x() - std::sin(2.0 * p.y())) - 0.3) * std::sqrt(0.2); });
  const auto lines = contour_lines(field, flat_view(200, 160, 0.05), {{100.0, 80.0}});
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines)
    for (const Vec3& p : line.world) EXPECT_NEAR(std::abs(p.x() - std::sin(2.0 * p.y())), 0.3, 1e-6);
}

TEST(ContourLines, ThinLumensAreFollowed) {
  // A lumen that narrows to a quarter of a cell between corners and widens again.
  for (const double offset : {0.0, 0.13, 0.5, 0.77, 1.0, 1.6}) {
    const auto half_width = [](double y) { return 1.0 - 0.94 * std::exp(-y * y / 2.0); };
    const FunctionField field(
        [=](const Vec3& p) { return std::abs(p.x() - 0.25 * offset) - half_width(p.y()); });
    std::vector<Vec2> seeds;
    for (int row = 0; row < 80; ++row) seeds.emplace_back(40.0 + offset, row + 0.5);
    const auto lines = contour_lines(field, flat_view(80, 80, 0.25), seeds);
    ASSERT_EQ(lines.size(), 2U) << offset;
    for (const ContourLine& line : lines)
      for (const Vec3& p : line.world) EXPECT_NEAR(std::abs(p.x() - 0.25 * offset), half_width(p.y()), 1e-6);
  }
}

TEST(ContourLines, ALumenWithinOneCellIsFoundAtItsSeed) {
  const FunctionField field(ball({0.13, 0.08, 0.0}, 0.06));
  const auto lines = contour_lines(field, flat_view(64, 64, 0.25), {{32.5, 32.3}});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed());
  EXPECT_GT(area_on_the_left(lines[0]), 0.0);
  for (const Vec3& p : lines[0].world) EXPECT_NEAR(std::hypot(p.x() - 0.13, p.y() - 0.08), 0.06, 1e-6);
}

TEST(ContourLines, WideFieldsThatSaturate) {
  std::vector<std::shared_ptr<const ScalarField>> branches{
      std::make_shared<FunctionField>(ball({-0.7, 0.0, 0.0}, 1.0)),
      std::make_shared<FunctionField>(ball({0.7, 0.0, 0.0}, 1.0))};
  const TreeField field(branches, {.width_mm = 0.25, .joints = JointShape::sharp});
  const auto lines = contour_lines(field, flat_view(128, 128, 0.05), {{50.0, 64.0}});
  ASSERT_EQ(lines.size(), 1U);
  for (const Vec3& p : lines[0].world)
    EXPECT_NEAR(std::min((p - Vec3(-0.7, 0.0, 0.0)).norm(), (p - Vec3(0.7, 0.0, 0.0)).norm()), 1.0, 1e-6);
}

TEST(ContourLines, SaddlesAreJoinedByWhatLiesBetween) {
  for (const double level : {0.004, -0.004}) {  // the lumen's halves apart, or in one
    const FunctionField field([=](const Vec3& p) {
      return 0.5 * (p.y() * p.y() - p.x() * p.x()) + level + 0.1 * std::pow(p.squaredNorm(), 2);
    });
    const auto lines = contour_lines(field, flat_view(90, 90, 0.1), {{30.2, 45.1}, {60.2, 45.1}});
    EXPECT_EQ(lines.size(), level > 0.0 ? 2U : 1U);
    for (const ContourLine& line : lines) {
      EXPECT_TRUE(line.closed());
      EXPECT_GT(area_on_the_left(line), 0.0);
    }
  }
}

TEST(ContourLines, StraightenedTubeIsTwoStraightWalls) {
  const auto axis = testing::bent_axis(40.0);
  const FunctionField field([&](const Vec3& p) { return axis->nearest_foot(p).rho_mm - 1.5; });
  reformat::CurvedOptions options;
  options.pixel_mm = 0.2;
  options.width = 64;
  options.height = 150;
  options.s_start_mm = 4.0;
  options.theta_deg = 30.0;
  const reformat::CurvedReformation view(axis, options);
  const auto lines = contour_lines(field, view_of(view), view.axis_px());
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines) {
    EXPECT_NEAR(std::abs(line.picture_px.front().y() - line.picture_px.back().y()), 150.0, 1e-9);
    for (const Vec2& px : line.picture_px) EXPECT_NEAR(std::abs(px.x() - 32.0), 7.5, 1e-4);
  }
}

TEST(ContourLines, WhereAViewJumpsThereIsNoPointOffTheWall) {
  const FunctionField field([](const Vec3& p) { return std::hypot(p.x() - 0.1 * p.y(), p.z()) - 1.0; });
  ViewSurface view = flat_view(80, 80, 0.1);
  view.world = [flat = view.world](const Vec2& px) -> Vec3 {
    return flat(px) + Vec3(0.0, px.y() > 40.7 ? 6.0 : 0.0, 0.0);  // the walls move by 0.6 mm
  };
  std::vector<Vec2> seeds;
  for (int row = 0; row < 80; ++row) seeds.emplace_back(40.0 + (row > 40 ? 6.0 : 0.0), row + 0.5);
  const auto lines = contour_lines(field, view, seeds);
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines)
    for (const Vec3& p : line.world) EXPECT_LE(std::abs(field.value(p)), 1e-6);
}

TEST(ContourLines, SameBitsWithAnyNumberOfThreads) {
  const auto vessel = testing::tube_vessel(testing::bent_axis(30.0), [](double, double) { return 1.4; });
  const ImplicitSurface field = solve(vessel);
  reformat::CurvedOptions options;
  options.s_start_mm = -5.0;
  options.height = 160;
  options.width = 100;
  const reformat::CurvedReformation view(vessel.axis, options);
  const auto several = contour_lines(field, view_of(view), view.axis_px());
  core::set_max_threads(1);
  const auto one = contour_lines(field, view_of(view), view.axis_px());
  core::set_max_threads(0);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(several.size(), 1U);
  EXPECT_TRUE(one[0].closed());
  EXPECT_EQ(one[0].picture_px, several[0].picture_px);
  EXPECT_EQ(one[0].world, several[0].world);
  for (const Vec3& p : one[0].world) EXPECT_LT(std::abs(field.value(p)), 1e-6);
}

TEST(ContourLines, BadInputIsRefused) {
  const FunctionField field(ball(Vec3::Zero(), 1.0));
  const ViewSurface view = flat_view(64, 64, 0.1);
  EXPECT_THROW(contour_lines(field, view, {}), InvalidInput);
  EXPECT_THROW(contour_lines(field, view, {{-3.0, 4.0}, {std::nan(""), 1.0}}), InvalidInput);
  EXPECT_THROW(contour_lines(field, view, {{32.0, 32.0}}, {.step_px = 0.1}), InvalidInput);
  EXPECT_THROW(contour_lines(field, view, {{32.0, 32.0}}, {.bend_px = 0.0}), InvalidInput);
  EXPECT_THROW(contour_lines(field, view, {{32.0, 32.0}}, {.largest_mm = std::nan("")}), InvalidInput);
  EXPECT_THROW(contour_lines(field, flat_view(0, 64, 0.1), {{0.0, 32.0}}), InvalidInput);
  EXPECT_THROW(contour_lines(field, flat_view(64, 64, 0.0), {{32.0, 32.0}}), InvalidInput);
  EXPECT_THROW(contour_lines(field, {64, 64, 0.1, {}, {}}, {{32.0, 32.0}}), InvalidInput);
  const FunctionField nan([](const Vec3& p) { return p.x() > 0.5 ? std::nan("") : p.norm() - 1.0; });
  EXPECT_THROW(contour_lines(nan, view, {{32.0, 32.0}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
